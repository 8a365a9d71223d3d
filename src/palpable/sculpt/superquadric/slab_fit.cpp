// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/slab_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace palpable::sculpt {
namespace {

struct Span {
  double low = 0.0, high = 0.0;
  double length() const { return high - low; }
};

/// The interval of the middle 98 % of the points along a direction.
Span span_along(std::span<const Vec3> points, Vec3 axis) {
  std::vector<double> at;
  at.reserve(points.size());
  for (const Vec3 p : points) at.push_back(dot(p, axis));
  const std::size_t out = at.size() / 100;
  std::nth_element(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(out), at.end());
  const double low = at[out];
  const auto high = at.end() - 1 - static_cast<std::ptrdiff_t>(out);
  std::nth_element(at.begin(), high, at.end());
  return {low, *high};
}

}  // namespace

std::vector<Parameter> parameters_of(SlabOptions& o) {
  return {{"trials", &o.trials, {1, 1e6}, "", "random triples of points for a plane"},
          {"sampled_points", &o.sampled_points, {1, 1e6}, "", "points that a plane is compared with"},
          {"thickness", &o.thickness, {0.0001, 1.0}, "", "thickness of a slab over its longer side"},
          {"directions", &o.directions, {1, 1000}, "", "directions that are tried for its sides"}};
}

double thickness_m(std::span<const Vec3> points_m) {
  const Plane plane = plane_through(points_m);
  double squares = 0.0;
  for (const Vec3 p : points_m) squares += plane.height_m(p) * plane.height_m(p);
  return std::sqrt(squares / static_cast<double>(points_m.size()));
}

std::vector<std::size_t> members_of_largest_plane(std::span<const Vec3> points_m, double reach_m,
                                                  double least_share, const SlabOptions& options,
                                                  std::uint64_t seed) {
  const auto members_of = [&](const Plane& plane) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < points_m.size(); ++i)
      if (std::abs(plane.height_m(points_m[i])) <= reach_m) members.push_back(i);
    return members;
  };
  std::mt19937_64 random(seed);
  const auto any = [&] { return points_m[random() % points_m.size()]; };
  const std::size_t step =
      std::max<std::size_t>(1, points_m.size() / static_cast<std::size_t>(options.sampled_points));
  Plane best;
  std::size_t most = 0;
  for (int k = 0; k < options.trials; ++k) {
    const Vec3 a = any();
    const Vec3 normal = unit(cross(any() - a, any() - a));
    if (squared_norm(normal) == 0.0) continue;
    const Plane plane{normal, dot(normal, a)};
    std::size_t count = 0;
    for (std::size_t i = 0; i < points_m.size(); i += step)
      if (std::abs(plane.height_m(points_m[i])) <= reach_m) ++count;
    if (count <= most) continue;
    most = count;
    best = plane;
  }
  auto members = members_of(best);
  if (members.size() < 3) return {};
  std::vector<Vec3> on;
  for (const std::size_t i : members) on.push_back(points_m[i]);
  members = members_of(plane_through(on));
  if (static_cast<double>(members.size()) < least_share * static_cast<double>(points_m.size())) return {};
  return members;
}

models::Superquadric slab_of(std::span<const Vec3> points_m, const std::optional<Point<SceneFrame>>& eye,
                             const SlabOptions& options) {
  const Plane plane = plane_through(points_m);
  Vec3 n = plane.normal;
  double front_m = plane.offset_m;
  if (eye && plane.height_m(eye->v) < 0.0) {
    n = -n;
    front_m = -front_m;
  }
  const Vec3 helper = std::abs(n.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 first = unit(cross(helper, n)), second = cross(n, first);
  double least_m2 = std::numeric_limits<double>::infinity();
  Vec3 u, v;
  Span along_u, along_v;
  for (int k = 0; k < options.directions; ++k) {
    const double angle = 0.5 * std::numbers::pi * k / options.directions;
    const Vec3 a = std::cos(angle) * first + std::sin(angle) * second, b = cross(n, a);
    const Span sa = span_along(points_m, a), sb = span_along(points_m, b);
    if (sa.length() * sb.length() >= least_m2) continue;
    least_m2 = sa.length() * sb.length();
    u = a, v = b, along_u = sa, along_v = sb;
  }
  models::Superquadric slab;
  const double longest_m = std::max(along_u.length(), along_v.length());
  const double least_m = 1e-3 * longest_m, half_m = 0.5 * options.thickness * longest_m;
  slab.size_m = {std::max(0.5 * along_u.length(), least_m), std::max(0.5 * along_v.length(), least_m),
                 half_m};
  slab.e1 = slab.e2 = models::kLeastExponent;
  const double depth_m = eye ? front_m - half_m : front_m;
  slab.scene_from_shape.rotation = {u.x, v.x, n.x, u.y, v.y, n.y, u.z, v.z, n.z};
  slab.scene_from_shape.translation_m =
      0.5 * (along_u.low + along_u.high) * u + 0.5 * (along_v.low + along_v.high) * v + depth_m * n;
  return slab;
}

}  // namespace palpable::sculpt
