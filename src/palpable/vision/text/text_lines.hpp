// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/picture/image.hpp"

#include <vector>

namespace palpable::vision {

struct TextLineOptions {
  /// Least difference between lettering and what is around it, grey levels 0 ... 255.
  double contrast = 80.0;
  /// Ink also has at least this part of the strongest difference nearby, which separates letters.
  double separation = 0.55;
  /// Largest distance between the mean colours of letters of one line (RGB, 0 ... 441).
  double most_colour_difference = 70.0;
  /// Sizes of a letter (the longer side of its box), pixels.
  double smallest_letter_px = 2.0;
  double largest_letter_px = 40.0;
  /// Strokes are thinner than this, pixels.
  int thickest_stroke_px = 7;
  /// Largest gap between neighbouring letters, in the size of the letters around.
  double largest_gap = 0.9;
  /// Largest gap between the words of a line, in heights.
  double largest_word_gap = 1.1;
  /// Letters belong to one line if the direction between them differs by less than this from the direction of
  /// the letters around them, degrees.
  double most_turn_deg = 35.0;
  /// Fewest pieces of ink in a line, and its least length in its heights.
  int fewest_letters = 2;
  double least_length = 1.8;
};

/// A line of lettering.
struct TextLine {
  /// The middle of the letters, from one end to the other, about one point a pixel; the reading direction is
  /// not known.
  std::vector<MapPoint> centre;
  /// Height of the letters across the line, pixels.
  double height_px = 0.0;
  Rgb8 colour;
  /// Number of connected pieces of ink.
  int letters = 0;
};

/// Lines of dark lettering at any angle and along curves: pieces of ink of similar size in a row. The
/// direction is that of total least squares, with a curve of second degree along it. Marks in a row (arrows,
/// dashes) may be among them. Any thread.
std::vector<TextLine> find_text_lines(const Raster<Rgb8>& picture, const TextLineOptions& options = {});

}  // namespace palpable::vision
