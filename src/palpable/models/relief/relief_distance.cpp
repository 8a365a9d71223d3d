// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_distance.hpp"

#include "palpable/models/relief/nearest_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpable::models {
namespace {

/// A starting point for Newton's method, and the squared distance of the surface there.
struct Start {
  double x_m;
  double y_m;
  double distance2;
};

Vec3 surface_at(const CurvedSample& s, double x_m, double y_m) { return {x_m, y_m, s.z_m}; }

/// Newton's method from one starting point, until a step is below 0.1 nm.
Vec3 descend(const Relief& relief, Vec3 p, double x_m, double y_m) {
  constexpr int kMostSteps = 80;
  constexpr double kEnough_m = 1e-10;
  CurvedSample s = relief.curved_sample(x_m, y_m);
  double shorter = 1.0;
  for (int k = 0; k < kMostSteps; ++k) {
    const Vec3 here = surface_at(s, x_m, y_m);
    const auto [dx, dy] =
        step_towards_nearest(way_from_surface(p - here, s), s, shorter, shorter * relief.pixel_m());
    if (std::hypot(dx, dy) < kEnough_m) break;
    const CurvedSample next = relief.curved_sample(x_m + dx, y_m + dy);
    if (squared_norm(p - surface_at(next, x_m + dx, y_m + dy)) > squared_norm(p - here)) {
      shorter *= 0.5;
      continue;
    }
    shorter = std::min(1.0, 2.0 * shorter);
    x_m += dx;
    y_m += dy;
    s = next;
  }
  return surface_at(s, x_m, y_m);
}

/// Surface points at samples within `reach_m` that are nearer to p than their eight neighbours, nearest
/// first.
std::vector<Start> local_minima(const Relief& relief, Vec3 p, double reach_m) {
  const Raster<float>& z = relief.samples_m();
  const double pixel = relief.pixel_m();
  const double centre_x = 0.5 * (z.width() - 1);
  const double centre_y = 0.5 * (z.height() - 1);
  const auto held = [](double v, int count) { return static_cast<int>(std::clamp(v, 0.0, count - 1.0)); };
  const int left = held(std::floor((p.x - reach_m) / pixel + centre_x), z.width());
  const int right = held(std::ceil((p.x + reach_m) / pixel + centre_x), z.width());
  const int top = held(std::floor(centre_y - (p.y + reach_m) / pixel), z.height());
  const int bottom = held(std::ceil(centre_y - (p.y - reach_m) / pixel), z.height());
  const auto place = [&](int i, int j) {
    const double x = (i - centre_x) * pixel;
    const double y = (centre_y - j) * pixel;
    return Vec3{x, y, relief.sample(x, y).z_m};
  };
  const auto distance2 = [&](int i, int j) { return squared_norm(place(i, j) - p); };

  Raster<double> far2(right - left + 1, bottom - top + 1);
  for (int j = top; j <= bottom; ++j)
    for (int i = left; i <= right; ++i) far2(i - left, j - top) = distance2(i, j);
  std::vector<Start> starts;
  for (int j = 0; j < far2.height(); ++j)
    for (int i = 0; i < far2.width(); ++i) {
      bool lowest = true;
      for (int b = -1; b <= 1 && lowest; ++b)
        for (int a = -1; a <= 1 && lowest; ++a)
          lowest = !far2.contains(i + a, j + b) || far2(i, j) <= far2(i + a, j + b);
      const Vec3 at = place(i + left, j + top);
      if (lowest) starts.push_back({at.x, at.y, far2(i, j)});
    }
  std::sort(starts.begin(), starts.end(),
            [](const Start& a, const Start& b) { return a.distance2 < b.distance2; });
  return starts;
}

}  // namespace

std::optional<ClosestPoint> closest_point(const Relief& relief, Point<SceneFrame> point) {
  const Vec3 p = point.v;
  if (!is_finite(p) || std::abs(p.x) > 0.5 * relief.size_x_m() || std::abs(p.y) > 0.5 * relief.size_y_m())
    return std::nullopt;
  // The vertical distance is an upper bound, which also bounds the horizontal distance.
  const double height_m = relief.sample(p.x, p.y).z_m;
  Vec3 best = descend(relief, p, p.x, p.y);
  const double reach_m = norm(p - best);
  // A sample differs from the spline by less than its pixel times the slope; farther samples cannot lead to a
  // nearer point.
  const double slack_m = relief.pixel_m() * (1.5 + relief.steepest_slope());
  if (reach_m > 0.0)
    for (const Start& start : local_minima(relief, p, reach_m)) {
      if (std::sqrt(start.distance2) > norm(p - best) + slack_m) break;
      const Vec3 found = descend(relief, p, start.x_m, start.y_m);
      if (squared_norm(p - found) < squared_norm(p - best)) best = found;
    }
  const HeightSample s = relief.sample(best.x, best.y);
  ClosestPoint closest;
  closest.surface = {best};
  closest.distance_m = p.z < height_m ? -norm(p - best) : norm(p - best);
  closest.normal = {unit(Vec3{-s.dzdx, -s.dzdy, 1.0})};
  return closest;
}

}  // namespace palpable::models
