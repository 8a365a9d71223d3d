// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/ink.hpp"

#include <algorithm>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

cv::Mat ellipse_of(int side) { return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}); }

/// Whether a piece is a thin line longer than a letter: its pixels hardly more than its length.
bool is_thin_line(int pixels, double size_px, const TextLineOptions& options) {
  return size_px > options.thin_line_length_px && pixels < options.thin_line_px * size_px;
}

}  // namespace

cv::Mat luma_of(const Raster<Rgb8>& picture) {
  cv::Mat luma(picture.height(), picture.width(), CV_8U);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb8 c = picture(x, y);
      luma.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((299 * c.r + 587 * c.g + 114 * c.b) / 1000);
    }
  return luma;
}

cv::Mat darkness_of(const Raster<Rgb8>& picture, int stroke_px) {
  const cv::Mat luma = luma_of(picture);
  cv::Mat around;
  cv::morphologyEx(luma, around, cv::MORPH_CLOSE, ellipse_of(stroke_px));
  return around - luma;
}

cv::Vec3d mean_colour(const Raster<Rgb8>& picture, const std::vector<cv::Point>& pixels) {
  cv::Vec3d sum(0.0, 0.0, 0.0);
  for (const cv::Point p : pixels) {
    const Rgb8 c = picture(p.x, p.y);
    sum += cv::Vec3d(c.r, c.g, c.b);
  }
  return sum * (1.0 / static_cast<double>(pixels.size()));
}

std::vector<Ink> pieces_of_ink(const Raster<Rgb8>& picture, const TextLineOptions& options) {
  const cv::Mat contrast = darkness_of(picture, options.thickest_stroke_px);
  // Letters that nearly touch are separated by the grey between them.
  cv::Mat strongest;
  cv::dilate(contrast, strongest, ellipse_of(options.thickest_stroke_px + options.separation_margin_px));
  cv::Mat scaled;
  strongest.convertTo(scaled, CV_8U, options.separation);
  const cv::Mat is_ink = (contrast > options.contrast) & (contrast > scaled);
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(is_ink, labels, stats, centres, 8);
  std::vector<int> index(static_cast<std::size_t>(n), -1);
  std::vector<Ink> out;
  for (int i = 1; i < n; ++i) {
    const double size = std::max(stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    if (size < options.smallest_letter_px || size > options.largest_letter_px) continue;
    if (is_thin_line(stats.at<int>(i, cv::CC_STAT_AREA), size, options)) continue;
    index[static_cast<std::size_t>(i)] = static_cast<int>(out.size());
    out.push_back({{centres.at<double>(i, 0), centres.at<double>(i, 1)}, size, {}, {}});
  }
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (const int at = index[static_cast<std::size_t>(labels.at<int>(y, x))]; at >= 0)
        out[static_cast<std::size_t>(at)].pixels.emplace_back(x, y);
  for (Ink& ink : out) ink.colour = mean_colour(picture, ink.pixels);
  return out;
}

}  // namespace palpable::vision
