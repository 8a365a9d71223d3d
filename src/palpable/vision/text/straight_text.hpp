// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/vision/text/read_text.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <span>
#include <vector>

#include <opencv2/core.hpp>

// Inside vision's sources only.
namespace palpable::vision {

/// Makes pictures of lines of lettering as a reader wants them: straight, upright, enlarged, dark on white.
class StraightText {
 public:
  /// `grounds`: colours of areas, of which those that differ from a line's are made white around it.
  StraightText(const Raster<Rgb8>& picture, std::span<const Rgb8> grounds, const ReadTextOptions& options);

  /// Kinds of pictures, in which a reader errs differently.
  enum class Kind {
    /// How dark the strokes are against what is around them.
    strokes,
    /// The picture's own grey levels, with sharpened edges.
    sharpened,
    /// The picture's own grey levels, with more room between letters.
    stretched,
    /// How much of each pixel has the line's colour: borders and marks in other colours are white.
    covered,
  };
  /// Reading goes to the right in the result, from the line's last point to its first if `reversed`.
  cv::Mat of(const TextLine& line, bool reversed, Kind kind) const;

 private:
  Raster<Rgb8> picture_;
  std::vector<Rgb8> grounds_;
  ReadTextOptions options_;
};

}  // namespace palpable::vision
