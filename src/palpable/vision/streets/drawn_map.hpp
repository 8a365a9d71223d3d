// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/picture/image.hpp"

#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

// For tests: street maps drawn with exact positions.
namespace palpable::vision {

struct DrawnStyle {
  cv::Scalar land{242, 239, 233};
  cv::Scalar street{255, 255, 255};
  cv::Scalar casing{190, 190, 190};
  cv::Scalar building{217, 208, 201};
};

struct DrawnStreet {
  std::vector<cv::Point> points;
  int width_px = 14;
  std::string name = {};
};

/// Buildings on a grid, then the streets over them, with a border of one pixel each.
inline Image drawn_map(const std::vector<DrawnStreet>& streets, const DrawnStyle& style = {},
                       int side = 400) {
  cv::Mat canvas(side, side, CV_8UC3, style.land);
  for (int y = 10; y < side; y += 40)
    for (int x = 12; x < side; x += 40)
      cv::rectangle(canvas, {x, y, 20 + (x * 7 + y) % 9, 18 + (x + y * 3) % 8}, style.building, cv::FILLED);
  const auto lines = [&](int more, const cv::Scalar& colour) {
    for (const DrawnStreet& s : streets)
      cv::polylines(canvas, s.points, false, colour, s.width_px + more, cv::LINE_AA);
  };
  lines(2, style.casing);
  lines(0, style.street);
  Image out{side, side, 3, 8, {}};
  out.samples.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 3);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c)
        out.samples.push_back(static_cast<float>(canvas.at<cv::Vec3b>(y, x)[c]) / 255.0F);
  return out;
}

}  // namespace palpable::vision
