// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/contours/grooves.hpp"

#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

/// Distance in pixels to the nearest line, on a grid `scale` times finer. It is interpolated between the
/// pixels' exact distances, so that a line itself has no width.
cv::Mat distance_to_lines(const Raster<float>& lines, double scale) {
  cv::Mat none(lines.height(), lines.width(), CV_8U, cv::Scalar(255));
  for (int y = 0; y < lines.height(); ++y)
    for (int x = 0; x < lines.width(); ++x)
      if (lines(x, y) > 0.0F) none.at<std::uint8_t>(y, x) = 0;
  cv::Mat distance;
  cv::distanceTransform(none, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Size finer(static_cast<int>(std::lround(lines.width() * scale)),
                       static_cast<int>(std::lround(lines.height() * scale)));
  cv::resize(distance, distance, finer, 0, 0, cv::INTER_LINEAR);
  return distance;
}

}  // namespace

std::vector<Parameter> parameters_of(GrooveOptions& o) {
  return {{"width_m", &o.width_m, {0.0005, 0.02}, "m", "full width of a groove"},
          {"depth_m", &o.depth_m, {0.0001, 0.01}, "m", "depth of a groove at its middle"},
          {"samples_across_half", &o.samples_across_half, {1, 64}, "", "least samples across half a groove"},
          {"most_samples", &o.most_samples, {2, 16384}, "", "most samples along the plate"}};
}

Result<models::Relief> grooves_from_boundary_map(const models::BoundaryMap& map,
                                                 const GrooveOptions& options) {
  if (!(options.width_m >= 0.0005 && options.width_m <= 0.02))
    return Error{ErrorCode::usage, "the width of a groove must be 0.5 to 20 mm", {}};
  if (!(options.depth_m >= 0.0001 && options.depth_m <= 0.01))
    return Error{ErrorCode::usage, "the depth of a groove must be 0.1 to 10 mm", {}};
  if (auto in_range = check_ranges(options); !in_range) return in_range.error();
  const Raster<float> lines = boundary_lines(map);
  const double finest = options.most_samples / static_cast<double>(std::max(lines.width(), lines.height()));
  const double scale =
      std::max(1.0, std::min(2.0 * options.samples_across_half * map.pixel_m() / options.width_m, finest));
  const cv::Mat distance = distance_to_lines(lines, scale);
  const double sample_m = map.size_x_m() / distance.cols;
  Raster<float> height(distance.cols, distance.rows);
  for (int y = 0; y < height.height(); ++y) {
    for (int x = 0; x < height.width(); ++x) {
      const double across = std::min(
          1.0, static_cast<double>(distance.at<float>(y, x)) * map.pixel_m() / (0.5 * options.width_m));
      height(x, y) = static_cast<float>(options.depth_m * 0.5 * (1.0 - std::cos(std::numbers::pi * across)));
    }
  }
  return models::Relief::from_samples(std::move(height), sample_m);
}

}  // namespace palpable::sculpt
