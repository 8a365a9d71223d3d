// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/ink_coverage.hpp"

#include <algorithm>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {

cv::Mat coverage_of(const Raster<Rgb8>& picture, Rgb8 ink, int stroke_px, double tolerance) {
  cv::Mat colours(picture.height(), picture.width(), CV_8UC3);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb8 c = picture(x, y);
      colours.at<cv::Vec3b>(y, x) = {c.r, c.g, c.b};
    }
  cv::Mat ground;
  cv::morphologyEx(colours, ground, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {stroke_px, stroke_px}));
  cv::Mat out(colours.size(), CV_8U);
  const cv::Vec3d dark(ink.r, ink.g, ink.b);
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) {
      const cv::Vec3d light = ground.at<cv::Vec3b>(y, x);
      const cv::Vec3d to_ink = dark - light, to_pixel = cv::Vec3d(colours.at<cv::Vec3b>(y, x)) - light;
      const double part = std::max(0.0, to_pixel.dot(to_ink) / std::max(1.0, to_ink.dot(to_ink)));
      const double aside = cv::norm(to_pixel - part * to_ink);
      const double like = std::clamp(1.5 - aside / tolerance, 0.0, 1.0);
      out.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(255.0 * part * like);
    }
  return out;
}

}  // namespace palpable::vision
