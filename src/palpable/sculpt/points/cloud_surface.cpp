// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/cloud_surface.hpp"

#include "palpable/sculpt/points/point_index.hpp"
#include "palpable/sculpt/triangles/box.hpp"
#include "palpable/sculpt/triangles/dual_contour.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace palpable::sculpt {
namespace {

constexpr std::size_t kFewest = 16;
Result<void> check(const PointCloud& cloud) {
  if (cloud.places_m.size() < kFewest) return invalid_input("holds fewer than 16 points");
  if (cloud.normals.size() != cloud.places_m.size())
    return invalid_input(
        "holds points without normals, which say on which side the solid is: add nx, ny, nz");
  const auto finite = [](Vec3 v) { return is_finite(v); };
  if (!std::all_of(cloud.places_m.begin(), cloud.places_m.end(), finite) ||
      !std::all_of(cloud.normals.begin(), cloud.normals.end(), finite))
    return invalid_input("holds a point that is not a finite number");
  return {};
}

/// Whether all places lie on one plane (or line, or place), to a thousandth of their extent.
bool on_a_plane(const std::vector<Vec3>& places) {
  const auto farthest = [&](auto measure) {
    return *std::max_element(places.begin(), places.end(),
                             [&](Vec3 p, Vec3 q) { return measure(p) < measure(q); });
  };
  const Vec3 a = places.front();
  const Vec3 b = farthest([&](Vec3 p) { return squared_norm(p - a); });
  const Vec3 along = unit(b - a);
  const Vec3 c = farthest([&](Vec3 p) { return squared_norm(cross(along, p - a)); });
  const Vec3 normal = unit(cross(along, c - a));
  const Vec3 d = farthest([&](Vec3 p) { return std::abs(dot(normal, p - a)); });
  return !(std::abs(dot(normal, d - a)) > 1e-3 * norm(b - a));
}

/// Distance to the k-th neighbour, which is expected about `guess_m` away.
double reach_of(const PointIndex& index, Vec3 p, std::size_t k, double guess_m, double most_m) {
  std::vector<double> squared;
  for (double radius_m = guess_m;; radius_m *= 2.0) {
    squared.clear();
    index.within(p, radius_m, [&](std::uint32_t, double s) { squared.push_back(s); });
    if (squared.size() > k) break;
    if (radius_m > most_m) return most_m;
  }
  const auto at = squared.begin() + static_cast<std::ptrdiff_t>(k);
  std::nth_element(squared.begin(), at, squared.end());
  return std::sqrt(*at);
}

/// Each point as a small triangle in its tangent plane with the area that it represents, for the winding
/// number.
Mesh point_triangles(const PointCloud& cloud, const std::vector<double>& reaches_m, std::size_t neighbours) {
  Mesh mesh;
  for (std::size_t i = 0; i < cloud.places_m.size(); ++i) {
    const Vec3 n = unit(cloud.normals[i]);
    const double area_m2 = std::numbers::pi * reaches_m[i] * reaches_m[i] / static_cast<double>(neighbours);
    const Vec3 other = std::abs(n.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    const Vec3 u = unit(cross(n, other)), v = cross(n, u);
    // An equilateral triangle of circumradius r has the area 3 sqrt(3) / 4 r^2.
    const double r = std::sqrt(area_m2 * 4.0 / (3.0 * std::numbers::sqrt3));
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (int k = 0; k < 3; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 3.0;
      mesh.vertices_m.push_back(cloud.places_m[i] + r * (std::cos(angle) * u + std::sin(angle) * v));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// The solid as a function: near points the mean of their tangent planes, elsewhere the winding number.
class CloudSolid {
 public:
  CloudSolid(const PointCloud& cloud, const PointIndex& index, const TriangleTree& point_triangles,
             double radius_m, const CloudOptions& options)
      : cloud_(cloud),
        index_(index),
        point_triangles_(point_triangles),
        radius_m_(radius_m),
        options_(options) {}

  models::DistanceSample at(Vec3 p) const {
    double weights = 0.0, height_m = 0.0;
    Vec3 normal;
    int count = 0;
    index_.within(p, radius_m_, [&](std::uint32_t i, double squared) {
      const double rest = 1.0 - squared / (radius_m_ * radius_m_);
      const double w = rest * rest * rest;
      height_m += w * dot(cloud_.normals[i], p - cloud_.places_m[i]);
      normal += w * cloud_.normals[i];
      weights += w;
      ++count;
    });
    if (count >= options_.least_points && weights > 0.0 && norm(normal) > options_.least_agreement * weights)
      return {height_m / weights, unit(normal)};
    const auto value = [&](Vec3 q) { return 2.0 * radius_m_ * (0.5 - point_triangles_.winding(q)); };
    const double step_m = 0.25 * radius_m_;
    const double here = value(p);
    const Vec3 slope{value(p + Vec3{step_m, 0, 0}) - here, value(p + Vec3{0, step_m, 0}) - here,
                     value(p + Vec3{0, 0, step_m}) - here};
    return {here, slope / step_m};
  }

 private:
  const PointCloud& cloud_;
  const PointIndex& index_;
  const TriangleTree& point_triangles_;
  double radius_m_;
  const CloudOptions& options_;
};

}  // namespace

std::vector<Parameter> parameters_of(CloudOptions& o) {
  return {
      {"resolution", &o.resolution, {8, 4096}, "cubes", "cubes of the surface along the longest side"},
      {"neighbours", &o.neighbours, {3, 100}, "", "neighbours that measure the spacing of the points"},
      {"radius_spacings",
       &o.radius_spacings,
       {1.0, 20.0},
       "spacings",
       "radius of the mean of tangent planes"},
      {"least_points", &o.least_points, {1, 100}, "", "points that this mean needs"},
      {"least_agreement", &o.least_agreement, {0.0, 1.0}, "", "length of their mean normal that it needs"}};
}

Result<Mesh> surface_of_cloud(const PointCloud& cloud, const CloudOptions& options, const Work& work) {
  if (const auto valid = check_ranges(options); !valid) return valid.error();
  if (const auto valid = check(cloud); !valid) return valid.error();
  PointCloud points = cloud;
  for (Vec3& n : points.normals) n = unit(n);
  Box box = bounds_of(points.places_m);
  const Vec3 size = box.size_m();
  const double longest_m = std::max({size.x, size.y, size.z});
  if (on_a_plane(points.places_m))
    return invalid_input("holds points that lie on one plane or line, which enclose no volume");
  work.report(0.0, "measuring the spacing of the points");
  const double guess_m = longest_m / std::sqrt(static_cast<double>(points.places_m.size()));
  const PointIndex index(points.places_m, 2.0 * guess_m);
  const auto neighbours = static_cast<std::size_t>(options.neighbours);
  std::vector<double> reaches_m(points.places_m.size());
  parallel_for(work, static_cast<int>(reaches_m.size()), 256, [&](int begin, int end) {
    for (int i = begin; i < end && !work.cancelled(); ++i)
      reaches_m[static_cast<std::size_t>(i)] =
          reach_of(index, points.places_m[static_cast<std::size_t>(i)], neighbours, guess_m, longest_m);
  });
  if (work.cancelled()) return Work::interrupted();
  std::vector<double> sorted = reaches_m;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  // On an evenly sampled surface n neighbours lie within about sqrt(n / pi) spacings, 8 of them within 1.6.
  const double reach_spacings = 1.6 * std::sqrt(options.neighbours / 8.0);
  const double spacing_m = std::max(*middle / reach_spacings, longest_m / 2048.0);
  // Limits the area of isolated points.
  for (double& reach : reaches_m) reach = std::min(reach, 4.0 * *middle);
  const TriangleTree tree(point_triangles(points, reaches_m, neighbours));
  const CloudSolid solid(points, index, tree, options.radius_spacings * spacing_m, options);
  const double margin_m = 4.0 * spacing_m + 0.05 * longest_m;
  box.least_m -= Vec3{margin_m, margin_m, margin_m};
  box.most_m += Vec3{margin_m, margin_m, margin_m};
  const double cube_m = std::max(spacing_m, longest_m / options.resolution);
  auto mesh = dual_contour([&](Vec3 p) { return solid.at(p); }, box, points.places_m, {cube_m}, work);
  if (!mesh) return mesh.error();
  if (mesh->triangles.empty()) return invalid_input("holds points that enclose no volume");
  return mesh;
}

}  // namespace palpable::sculpt
