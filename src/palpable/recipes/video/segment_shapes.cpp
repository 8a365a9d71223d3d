// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/segment_shapes.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace palpable::recipes {
namespace {

// Sums over the pixels of a segment.
struct Moments {
  double count = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  bool at_border = false;
  void add(double u, double v) { ++count, x += u, y += v, xx += u * u, xy += u * v, yy += v * v; }
};

std::map<int, Moments> moments_of(const Raster<int>& segments) {
  std::map<int, Moments> out;
  for (int y = 0; y < segments.height(); ++y)
    for (int x = 0; x < segments.width(); ++x) {
      Moments& m = out[segments(x, y)];
      m.add(x, y);
      m.at_border =
          m.at_border || x == 0 || y == 0 || x + 1 == segments.width() || y + 1 == segments.height();
    }
  return out;
}

double median_depth(const DepthMap& map) {
  std::vector<float> known;
  std::copy_if(map.depth_m.values().begin(), map.depth_m.values().end(), std::back_inserter(known),
               [](float z) { return z > 0; });
  return known.empty() ? 0.0 : static_cast<double>(quantile_of(known, 0.5));
}

// A uniform distribution over half-width a has the variance a^2 / 3 in one dimension and a^2 / 4 over an
// ellipse: between both.
constexpr double kHalfWidth = 1.87;
constexpr double kExponent = 0.5;

models::Superquadric shape_of(const Moments& m, double depth, const Pinhole& camera,
                              const Transform<SceneFrame, CameraFrame>& axes_from_camera) {
  const double x = m.x / m.count, y = m.y / m.count;
  const double xx = m.xx / m.count - x * x, yy = m.yy / m.count - y * y, xy = m.xy / m.count - x * y;
  const double mean = (xx + yy) / 2, spread = std::hypot((xx - yy) / 2, xy);
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const double unit = depth / camera.fx;
  const double length = kHalfWidth * std::sqrt(mean + spread) * unit,
               width = kHalfWidth * std::sqrt(std::max(1.0, mean - spread)) * unit;
  models::Superquadric out;
  out.e1 = out.e2 = kExponent;
  out.size_m = {length, width, (length + width) / 2};
  const double c = std::cos(angle), s = std::sin(angle);
  const Transform<CameraFrame, models::ShapeFrame> camera_from_shape{
      {c, -s, 0, s, c, 0, 0, 0, 1}, {(x - camera.cx) * unit, (y - camera.cy) * unit, depth}, 1.0};
  out.scene_from_shape = axes_from_camera * camera_from_shape;
  return out;
}

}  // namespace

Result<std::vector<models::Superquadric>> shapes_of_segments(const Raster<Rgb8>& picture,
                                                             const vision::FrameDepth& map,
                                                             const VideoModel& model,
                                                             const vision::VideoSegmentOptions& options) {
  vision::VideoSegmenter segmenter(options);
  const auto segments = segmenter.add({picture, {}, {}});
  if (!segments) return segments.error();
  const double depth = median_depth(map.map.depth);
  std::vector<models::Superquadric> out;
  if (!(depth > 0)) return out;
  const auto axes_from_camera = model.axes.axes_from_world() * map.map.pose;
  for (const auto& [identity, moments] : moments_of(segments->of_pixel))
    if (!moments.at_border) out.push_back(shape_of(moments, depth, *map.map.depth.camera, axes_from_camera));
  return out;
}

}  // namespace palpable::recipes
