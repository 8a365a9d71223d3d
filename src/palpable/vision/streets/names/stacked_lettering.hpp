// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/vision/text/read_text.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

/// Maps write long names of places in several level lines, one centred below the other ("Restaurant" above
/// "Seeblick"); names of streets are written in one line.
struct StackedLetteringOptions {
  /// Level lines differ from the horizontal by at most this, degrees. 0 ... 45.
  double most_slope_deg = 12.0;
  /// Greatest distance between the middles of two lines of a stack: across, in the height of the higher one,
  /// 0
  /// ... 10, and along, in the mean of their heights, 0 ... 10.
  double most_distance = 2.5;
  double most_aside = 1.0;
  /// Least distance across, in the height of the lower one: nearer lines are the same lettering. 0 ... 5.
  double least_distance = 0.6;
  /// The higher one is at most this many times as high. 1 ... 10.
  double most_height_ratio = 1.8;
  /// Largest distance between their mean colours, RGB levels. 0 ... 442.
  double most_colour_difference = 60.0;
};
std::vector<Parameter> parameters_of(StackedLetteringOptions& options);

/// For each line of lettering, whether it is one of a stack, 0 or 1: another one that says something stands
/// above or below it. `read` belongs to `lines`, one for one. Any thread.
std::vector<char> stacked_lettering(std::span<const TextLine> lines, std::span<const ReadLine> read,
                                    const StackedLetteringOptions& options = {});

}  // namespace palpable::vision
