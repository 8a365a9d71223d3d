// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/text/ink.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <vector>

#include <opencv2/core.hpp>

// Inside vision's sources only.
namespace palpable::vision {

/// A line of lettering with its ink.
struct InkLine {
  TextLine line;
  std::vector<cv::Point> pixels;
  cv::Rect box;
};

/// The direction of total least squares through pixels, of length 1.
cv::Point2d direction_of(const std::vector<cv::Point>& pixels);

/// Fits a line's middle, a curve of second or third degree, and its height to its ink.
void fit_line(InkLine& ink, const TextLineOptions& options);

/// The line through pieces of ink, with their mean colour.
InkLine line_of(const std::vector<const Ink*>& pieces, const TextLineOptions& options);

/// Joins words that follow each other into one line, the nearest ones first.
void join_words(std::vector<InkLine>& lines, const TextLineOptions& options);

}  // namespace palpable::vision
