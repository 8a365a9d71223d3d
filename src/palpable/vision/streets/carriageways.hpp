// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/streets/centre_lines.hpp"

#include <vector>

namespace palpable::vision {

struct CarriagewayOptions {
  /// A street divides into two that are at most this much narrower: before that it has two carriageways.
  double fork_ratio = 1.35;
  /// A street has two carriageways if it is at least this many times as wide as the widest common streets of
  /// other colours.
  double width_ratio = 1.7;
  /// Streets of other colours are common if they have this part of the length of all.
  double common_part = 0.1;
  /// Wider streets have more than two carriageways and stay one, in widths of a carriageway.
  double most_widths = 2.6;
  /// Shorter pieces stay one, in their width.
  double least_length = 2.0;
  /// Carriageways whose middles are nearer to that of the street than this stay one, pixels.
  double least_offset_px = 2.5;
};

/// Divides the lines of streets with two carriageways that the map draws as one area: two lines instead of
/// one. `colours`: the centre lines of each colour of streets. Any thread.
void divide_carriageways(std::vector<CentreLines*> colours, const CarriagewayOptions& options = {});

}  // namespace palpable::vision
