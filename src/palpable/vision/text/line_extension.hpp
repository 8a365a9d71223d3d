// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

struct LineExtensionOptions {
  /// Ink differs from the lettering's colour by at most this, RGB levels, 0 ... 442, and from what is around
  /// it by at least this, grey levels. 1 ... 255.
  double most_colour_difference = 110.0;
  double contrast = 60.0;
  /// Largest gap before the next letter or word, and the farthest that a line goes on at an end, in its
  /// height. 0 ... 5 and 0 ... 50.
  double most_gap = 0.8;
  double most_length = 6.0;
  /// Ink that goes on beyond both sides of the line by this much, pixels, is a border across it. 1 ... 20.
  int beyond_px = 3;
  /// A line goes on if at least this part of its height is added. 0 ... 5.
  double least_length = 0.25;
};
std::vector<Parameter> parameters_of(LineExtensionOptions& options);

/// The lines of lettering behind whose ends more ink of their colour follows, longer by that: first letters
/// that touch a border are pieces of ink too large for letters, so find_text_lines() leaves them out. Lines
/// that do not go on are left out. Any thread.
std::vector<TextLine> extended_lines(const Raster<Rgb8>& picture, std::span<const TextLine> lines,
                                     int thickest_stroke_px, const LineExtensionOptions& options = {});

}  // namespace palpable::vision
