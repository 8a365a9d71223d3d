// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"

#include <vector>

namespace palpable::vision {

/// How lettering is found. Defaults were chosen on drawn maps (docs/maps.md).
struct TextLineOptions {
  /// Least difference between lettering and what is around it, grey levels. 1 ... 255.
  double contrast = 80.0;
  /// Ink also has at least this part of the strongest difference nearby, which separates letters. 0 ... 1.
  double separation = 0.55;
  /// Nearby is what is at most a stroke and this much away, pixels. 0 ... 50.
  int separation_margin_px = 2;
  /// Largest distance between the mean colours of letters of one line, RGB levels. 0 ... 442.
  double most_colour_difference = 70.0;
  /// Least size of a letter (the longer side of its box), pixels. 1 ... 100, below largest_letter_px.
  double smallest_letter_px = 2.0;
  /// Greatest size of a letter, pixels. 2 ... 1000.
  double largest_letter_px = 40.0;
  /// Strokes are thinner than this, pixels. 1 ... 99.
  int thickest_stroke_px = 7;
  /// Ink that is longer and on average thinner than this is the border of a street or building, pixels. 1 ...
  /// 1000 and 0 ... 20.
  double thin_line_length_px = 14.0;
  double thin_line_px = 2.2;
  /// Largest gap between neighbouring letters, in the size of the smaller one, which counts at least as this
  /// part of the larger one. 0.1 ... 10 and 0 ... 1.
  double largest_gap = 0.9;
  double gap_size_part = 0.7;
  /// Largest distance between the middles of neighbouring letters, in the size of the larger one. 0.5 ... 10.
  double most_distance = 2.2;
  /// The larger one of neighbouring letters is at most this many times as large. 1 ... 20.
  double most_size_ratio = 4.0;
  /// Dots and accents are smaller than this part of their letter, and nearer to its middle than this part of
  /// its size: their direction says nothing. 0 ... 1 and 0 ... 5.
  double mark_size = 0.5;
  double mark_distance = 0.8;
  /// Letters belong to one line if the direction between them differs by less than this from the direction of
  /// the letters around them, degrees. 0 ... 90.
  double most_turn_deg = 35.0;
  /// Share of the ink on each side of a line's middle that its height leaves out. 0 ... 0.2.
  double height_outliers = 0.02;
  /// Lines longer than this many of their thicknesses may bend in two directions. 0 ... 100.
  double bending_length = 4.0;
  /// Largest gap between the words of a line, in heights. 0 ... 10.
  double largest_word_gap = 1.1;
  /// The higher one of two words of a line is less than this many times as high. 1 ... 10.
  double word_height_ratio = 1.8;
  /// The direction of a word at its end is that of this many heights of it. 0.1 ... 10.
  double word_end_heights = 1.5;
  /// Largest distance of the next word from that direction, and the part by which it may overlap, in heights.
  /// 0 ... 5 each.
  double word_aside = 0.6;
  double word_overlap = 0.3;
  /// A word that is at most this many heights of the longer word long and high has no direction of its own, 0
  /// ... 5: "II" is higher than long. It belongs to the line if it is at least this part of it high, 0 ... 1,
  /// and reaches beyond it by at most this part of its height, 0 ... 1.
  double short_word_heights = 1.6;
  double short_word_part = 0.5;
  double short_word_beyond = 0.25;
  /// A single piece of ink is a word from this size on, and a word is at least this high, in
  /// smallest_letter_px. 0 ... 10 each.
  double lone_letter = 2.0;
  double least_word_height = 1.2;
  /// Fewest pieces of ink in a line, and its least length in its heights. 1 ... 100 and 0 ... 100.
  int fewest_letters = 2;
  double least_length = 1.8;
};
std::vector<Parameter> parameters_of(TextLineOptions& options);

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
