// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <vector>

namespace palpable::vision {

/// How lettering of a known height and colour is followed. Lengths are in its height.
struct FollowedLinesOptions {
  /// Pixels of the lettering are covered with its colour by at least this part, 0.05 ... 1; other colours
  /// differ from its mixtures by more than this, RGB levels. 1 ... 442.
  double least_coverage = 0.45;
  double most_colour_difference = 45.0;
  /// The mean colour of a letter differs from that of the lettering by at most this. 0 ... 442.
  double most_letter_difference = 90.0;
  /// Sizes of letters, or of several that touch. 0 ... 1 and 1 ... 20.
  double smallest_letter = 0.35;
  double largest_letter = 4.0;
  /// Largest gap between letters that are followed. 0 ... 3.
  double most_gap = 0.7;
  /// The next letter's middle lies ahead by at least the first, and beside the line's direction by at most
  /// the second; it reaches no farther from the line than the third. 0 ... 2 each.
  double least_step = 0.15;
  double most_aside = 0.4;
  double most_reach = 0.8;
  /// The direction is that of the letters over this length. 0.5 ... 10.
  double direction_length = 3.0;
  /// What is followed is joined over gaps up to this, 0 ... 10, and turns up to this, degrees. 0 ... 90.
  double word_gap = 0.9;
  double word_turn_deg = 25.0;
  /// Least and greatest height, and least length of a line. 0 ... 1, 1 ... 5 and 0 ... 50.
  double least_height = 0.6;
  double most_height = 1.4;
  double least_length = 2.2;
  /// Fewest pieces of ink of a line. 2 ... 20.
  int fewest_letters = 3;
};
std::vector<Parameter> parameters_of(FollowedLinesOptions& options);

/// Lines of lettering of a known height and colour, from letter to letter: lines side by side, and names that
/// meet at an angle, stay apart, and marks and borders of other colours are left out. Any thread.
std::vector<TextLine> followed_lines(const Raster<Rgb8>& picture, double height_px, Rgb8 colour,
                                     const TextLineOptions& ink, const FollowedLinesOptions& options = {});

}  // namespace palpable::vision
