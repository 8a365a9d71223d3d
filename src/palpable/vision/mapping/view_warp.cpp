// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/view_warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::vision {
namespace {

/// A reading in the other picture: pixels, and its inverse depth, which is linear across a plane's picture.
struct Corner {
  double x = 0.0, y = 0.0;
  /// 1/m; NaN: not before the camera.
  double inverse = std::nan("");
};

using Triangle = std::array<const Corner*, 3>;

/// Twice the signed area; positive for the order of corners that a surface has from before.
double area(const Corner& a, const Corner& b, const Corner& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The nearer of what a pixel has and what a triangle shows there. `nearest` holds inverse depths, 0 = none.
void draw(const Triangle& t, Raster<float>& nearest) {
  // So that the corners themselves belong to the triangle in spite of rounding.
  constexpr double kBorder = 1e-6;
  const double whole = area(*t[0], *t[1], *t[2]);
  if (!(whole > kBorder)) return;
  const auto low = [](double v) { return static_cast<int>(std::ceil(v - kBorder)); };
  const auto high = [](double v) { return static_cast<int>(std::floor(v + kBorder)); };
  const auto [x0, x1] = std::minmax({t[0]->x, t[1]->x, t[2]->x});
  const auto [y0, y1] = std::minmax({t[0]->y, t[1]->y, t[2]->y});
  if (x1 < 0.0 || y1 < 0.0 || x0 > nearest.width() || y0 > nearest.height()) return;
  for (int y = std::max(0, low(std::max(y0, -1.0)));
       y <= std::min(nearest.height() - 1, high(std::min(y1, 1e6))); ++y)
    for (int x = std::max(0, low(std::max(x0, -1.0)));
         x <= std::min(nearest.width() - 1, high(std::min(x1, 1e6))); ++x) {
      const Corner p{static_cast<double>(x), static_cast<double>(y), 0.0};
      const double a = area(*t[1], *t[2], p) / whole;
      const double b = area(*t[2], *t[0], p) / whole;
      const double c = 1.0 - a - b;
      if (std::min({a, b, c}) < -kBorder) continue;
      const double inverse = a * t[0]->inverse + b * t[1]->inverse + c * t[2]->inverse;
      nearest(x, y) = std::max(nearest(x, y), static_cast<float>(inverse));
    }
}

bool is_same_place(const Transform<CameraFrame, CameraFrame>& t) {
  constexpr double kSame = 1e-9;
  return norm(t.translation_m) < kSame && t.rotation[0] + t.rotation[4] + t.rotation[8] > 3.0 - kSame;
}

}  // namespace

Raster<float> seen_from(const Raster<float>& depth_m, const Pinhole& camera,
                        const Transform<CameraFrame, CameraFrame>& view_from_camera, const Pinhole& view,
                        double same_surface) {
  if (camera == view && is_same_place(view_from_camera)) return depth_m;
  Raster<Corner> corners(depth_m.width(), depth_m.height());
  constexpr double kNearest_m = 0.01;
  for (int y = 0; y < depth_m.height(); ++y)
    for (int x = 0; x < depth_m.width(); ++x) {
      const double z = depth_m(x, y);
      if (!std::isfinite(z)) continue;
      const Vec3 ray{(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0};
      const Vec3 p = (view_from_camera * Point<CameraFrame>{z * ray}).v;
      if (p.z > kNearest_m)
        corners(x, y) = {view.cx + view.fx * p.x / p.z, view.cy + view.fy * p.y / p.z, 1.0 / p.z};
    }
  Raster<float> nearest(view.width, view.height, 0.0F);
  for (int y = 0; y + 1 < depth_m.height(); ++y)
    for (int x = 0; x + 1 < depth_m.width(); ++x) {
      const Corner *a = &corners(x, y), *b = &corners(x + 1, y), *c = &corners(x + 1, y + 1),
                   *d = &corners(x, y + 1);
      const auto one_surface = [&](const Triangle& t) {
        const auto [far, near] = std::minmax({t[0]->inverse, t[1]->inverse, t[2]->inverse});
        return std::isfinite(t[0]->inverse + t[1]->inverse + t[2]->inverse) &&
               1.0 / far - 1.0 / near <= same_surface / far;
      };
      // The diagonal between the more similar corners.
      const bool falling = !(std::abs(a->inverse - c->inverse) > std::abs(b->inverse - d->inverse));
      for (const Triangle& t : falling ? std::array<Triangle, 2>{{{a, b, c}, {a, c, d}}}
                                       : std::array<Triangle, 2>{{{a, b, d}, {b, c, d}}})
        if (one_surface(t)) draw(t, nearest);
    }
  for (float& value : nearest.values()) value = value > 0.0F ? 1.0F / value : kUnknownDepth;
  return nearest;
}

}  // namespace palpable::vision
