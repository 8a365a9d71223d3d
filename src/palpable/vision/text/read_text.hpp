// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <span>
#include <string>
#include <vector>

namespace palpable::vision {

struct ReadTextOptions {
  /// Tesseract's languages, "eng+deu"; empty: all that are installed.
  std::string languages;
  /// Height of the straightened letters, and the space around them in that height.
  int letter_px = 42;
  double margin = 0.35;
  /// Enlarged letters are smoothed by this part of their height: the standard deviation.
  double smoothing = 0.033;
  /// Each line is read at two more sizes, as parts of letter_px; two of the three readings must agree.
  double larger = 1.3;
  double smaller = 0.62;
  /// Lines that are read with less confidence are dropped, 0 ... 1.
  double least_confidence = 0.4;
  /// Lines that are read with less confidence are also read upside down.
  double sure = 0.8;
  /// Longest time for reading all lines, s.
  double most_seconds = 60.0;
};

/// What a line says.
struct ReadLine {
  /// UTF-8; empty if it could not be read.
  std::string text;
  /// 0 ... 1.
  double confidence = 0.0;
  /// Whether it is read from the last point of its line to the first.
  bool reversed = false;
};

/// One ReadLine for each line of lettering.
struct TextReading {
  std::vector<ReadLine> lines;
  std::vector<Note> notes;
};

/// Reads lines of lettering: each is straightened along its middle, enlarged and given to the program
/// `tesseract`, which runs in processes of its own; both ways up if needed. Without that program or its
/// language data, or where it fails, no line has a text, and a note says why. Long work: polls cancel.
/// Errors: interrupted.
Result<TextReading> read_text_lines(const Raster<Rgb8>& picture, std::span<const TextLine> lines,
                                    const ReadTextOptions& options, const Work& work);

}  // namespace palpable::vision
