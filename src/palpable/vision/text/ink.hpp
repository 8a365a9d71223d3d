// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <vector>

#include <opencv2/core.hpp>

// Inside vision's sources only.
namespace palpable::vision {

/// A connected piece of ink: a letter, several that touch, or a part of one.
struct Ink {
  cv::Point2d centre;
  /// The longer side of its box.
  double size_px = 0.0;
  /// Mean colour.
  cv::Vec3d colour{0.0, 0.0, 0.0};
  std::vector<cv::Point> pixels;
};

/// Grey levels, 0 ... 255.
cv::Mat luma_of(const Raster<Rgb8>& picture);

/// How much darker each pixel is than what is around it, grey levels 0 ... 255; strokes are narrower than
/// `stroke_px`.
cv::Mat darkness_of(const Raster<Rgb8>& picture, int stroke_px);

/// RGB, 0 ... 255 each; `pixels` is not empty.
cv::Vec3d mean_colour(const Raster<Rgb8>& picture, const std::vector<cv::Point>& pixels);

/// Pieces of dark ink of the size of letters. Long thin lines (the borders of streets and buildings) are left
/// out.
std::vector<Ink> pieces_of_ink(const Raster<Rgb8>& picture, const TextLineOptions& options);

}  // namespace palpable::vision
