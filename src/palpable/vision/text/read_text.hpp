// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <span>
#include <string>
#include <vector>

namespace palpable::vision {

/// How lettering is read. Defaults were chosen on drawn maps (docs/maps.md).
struct ReadTextOptions {
  /// Tesseract's languages, "eng+deu"; empty: all that are installed.
  std::string languages;
  /// Strokes are thinner than this, pixels of the picture. 1 ... 99.
  int thickest_stroke_px = 7;
  /// Lettering is as dark as the darkest stroke within half of this, pixels. 1 ... 99.
  int contrast_window_px = 15;
  /// Strokes of less contrast are not black, grey levels. 1 ... 255.
  double full_contrast = 60.0;
  /// Areas whose colour differs from that of a line by at least the first are the ground behind it, levels of
  /// the channel that differs most, 1 ... 255; their pixels differ by at most the second from it, half of
  /// them as much again, 1 ... 128.
  double ground_difference = 70.0;
  double ground_tolerance = 8.0;
  /// Height of the straightened letters, pixels. 12 ... 200.
  int letter_px = 42;
  /// Lower lines are enlarged as if they were this high, pixels of the picture. 1 ... 100.
  double least_height_px = 4.0;
  /// Space around the letters, in their height, 0 ... 2, and white above and below it, pixels, 0 ... 100;
  /// twice as much at the ends of the line.
  double margin = 0.35;
  int border_px = 8;
  /// Enlarged letters are smoothed by this part of their height: the standard deviation. 0 ... 0.5.
  double smoothing = 0.033;
  /// Each line is read again in its own grey levels, of which these parts are ink and darker, or ground and
  /// darker, 0 ... 1 each, with edges sharpened by this, 0 ... 5, over this part of the letters' height, 0.01
  /// ... 1; with one language also stretched by this, 1 ... 3. Two readings must agree.
  double ink_part = 0.02;
  double ground_part = 0.7;
  double sharpening = 1.0;
  double sharpening_radius = 0.08;
  double stretch = 1.2;
  /// Lines of which fewer than this part of the readings agree are read once more, 0 ... 1, from how much of
  /// each pixel has their colour, but for other colours that differ by this, RGB levels. 1 ... 442.
  double agreeing_part = 0.67;
  double most_colour_difference = 45.0;
  /// Fewest letters in what is read, and the least part of it that is letters. 1 ... 20 and 0 ... 1.
  int fewest_letters = 3;
  double letter_part = 0.5;
  /// Lines that are read with less confidence are dropped. 0 ... 1.
  double least_confidence = 0.4;
  /// Lines that are read with less confidence, 0 ... 1, are also read upside down; those that are no steeper
  /// than `level_deg`, degrees, 0 ... 90, only if few level ones are read with that confidence: then the
  /// picture may be upside down.
  double sure = 0.8;
  double level_deg = 30.0;
  /// Most processor time for reading all lines in each process, s; ten times as long by the clock. 1 ...
  /// 3600.
  double most_seconds = 60.0;
};
/// All but the languages.
std::vector<Parameter> parameters_of(ReadTextOptions& options);

/// What a line says.
struct ReadLine {
  /// UTF-8; empty if it could not be read.
  std::string text;
  /// 0 ... 1.
  double confidence = 0.0;
  /// Whether it is read from the last point of its line to the first.
  bool reversed = false;
  /// All that was read, among it what no second reading agrees with. For a gazetteer.
  std::vector<std::string> others = {};
  /// Sum of the squares of the confidences of the readings that say it.
  double weight = 0.0;
};

/// One ReadLine for each line of lettering.
struct TextReading {
  std::vector<ReadLine> lines;
  std::vector<Note> notes;
};

/// Reads lines of lettering: each is straightened along its middle, enlarged and given to the program
/// `tesseract`, which runs in processes of its own; both ways up if needed. Without that program or its
/// language data, or where it fails, no line has a text, and a note says why. Long work: polls cancel.
/// `grounds`: colours of the areas that lettering may lie on. Errors: interrupted.
Result<TextReading> read_text_lines(const Raster<Rgb8>& picture, std::span<const TextLine> lines,
                                    const ReadTextOptions& options, const Work& work,
                                    std::span<const Rgb8> grounds = {});

}  // namespace palpable::vision
