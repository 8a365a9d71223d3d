// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/ground_tilt.hpp"

#include "palpable/core/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace palpable::describe {
namespace {

constexpr int kTriples = 400;
constexpr std::size_t kMostPlaces = 2048;
constexpr int kRefinements = 3;

std::vector<Vec3> places_of(const Raster<float>& height_m, double cell_x_m, double cell_y_m) {
  const auto step = static_cast<int>(
      std::ceil(std::sqrt(static_cast<double>(height_m.count()) / static_cast<double>(kMostPlaces))));
  std::vector<Vec3> places;
  for (int j = step / 2; j < height_m.height(); j += std::max(1, step))
    for (int i = step / 2; i < height_m.width(); i += std::max(1, step))
      places.push_back({(i + 0.5 - 0.5 * height_m.width()) * cell_x_m,
                        (0.5 * height_m.height() - j - 0.5) * cell_y_m, double{height_m(i, j)}});
  return places;
}

std::optional<GroundPlane> plane_through(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = cross(b - a, c - a);
  // Triples that are seen almost as a line determine no plane.
  if (!(std::abs(n.z) > 1e-3 * norm(Vec3{b.x - a.x, b.y - a.y, 0.0}) * norm(Vec3{c.x - a.x, c.y - a.y, 0.0})))
    return std::nullopt;
  const double dzdx = -n.x / n.z, dzdy = -n.y / n.z;
  return GroundPlane{a.z - dzdx * a.x - dzdy * a.y, dzdx, dzdy};
}

std::size_t count_on(const GroundPlane& plane, const std::vector<Vec3>& places, double tolerance_m) {
  return static_cast<std::size_t>(std::count_if(places.begin(), places.end(), [&](Vec3 p) {
    return std::abs(p.z - plane.height_m(p.x, p.y)) <= tolerance_m;
  }));
}

/// Least squares over the places on the plane (normal equations about their mean).
GroundPlane refined(const GroundPlane& plane, const std::vector<Vec3>& places, double tolerance_m) {
  Vec3 mean;
  double count = 0.0;
  const auto is_on = [&](Vec3 p) { return std::abs(p.z - plane.height_m(p.x, p.y)) <= tolerance_m; };
  for (const Vec3 p : places)
    if (is_on(p)) mean += p, count += 1.0;
  if (count < 3.0) return plane;
  mean = mean / count;
  double xx = 0.0, xy = 0.0, yy = 0.0, xz = 0.0, yz = 0.0;
  for (const Vec3 p : places) {
    if (!is_on(p)) continue;
    const Vec3 d = p - mean;
    xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y, xz += d.x * d.z, yz += d.y * d.z;
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-6 * xx * yy)) return plane;
  const double dzdx = (xz * yy - yz * xy) / determinant, dzdy = (yz * xx - xz * xy) / determinant;
  return {mean.z - dzdx * mean.x - dzdy * mean.y, dzdx, dzdy};
}

}  // namespace

std::optional<GroundPlane> ground_plane_of(const Raster<float>& height_m, double cell_x_m, double cell_y_m,
                                           const GroundTiltOptions& options) {
  const auto [low, high] = std::minmax_element(height_m.values().begin(), height_m.values().end());
  const double tolerance_m = options.tolerance * (double{*high} - double{*low});
  const std::vector<Vec3> places = places_of(height_m, cell_x_m, cell_y_m);
  if (places.size() < 3 || !(tolerance_m > 0.0)) return std::nullopt;
  std::mt19937_64 random(1);
  const auto any = [&] { return places[static_cast<std::size_t>(random() % places.size())]; };
  GroundPlane best;
  std::size_t most = 0;
  for (int k = 0; k < kTriples; ++k) {
    const Vec3 a = any(), b = any(), c = any();
    const auto plane = plane_through(a, b, c);
    const std::size_t on = plane ? count_on(*plane, places, tolerance_m) : 0;
    if (on > most) most = on, best = *plane;
  }
  if (most == 0) return std::nullopt;
  for (int k = 0; k < kRefinements; ++k) best = refined(best, places, tolerance_m);
  const auto all = static_cast<double>(places.size());
  const auto below = static_cast<double>(std::count_if(
      places.begin(), places.end(), [&](Vec3 p) { return p.z < best.height_m(p.x, p.y) - tolerance_m; }));
  const auto on = static_cast<double>(count_on(best, places, tolerance_m));
  if (on < options.least_share * all || below > options.most_below * all) return std::nullopt;
  return best;
}

}  // namespace palpable::describe
