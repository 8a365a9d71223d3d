// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/table_axes.hpp"

#include "palpable/core/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>

namespace palpable::recipes {
namespace {

Vec3 mean_of(const std::vector<Vec3>& places) {
  Vec3 sum;
  for (const Vec3& place : places) sum += place;
  return sum / static_cast<double>(places.size());
}

// Median distance of the points from their mean.
double spread_of(const std::vector<Vec3>& places) {
  const Vec3 middle = mean_of(places);
  std::vector<double> distances;
  for (const Vec3& place : places) distances.push_back(norm(place - middle));
  return quantile_of(distances, 0.5);
}

std::vector<Vec3> on_plane(const std::vector<Vec3>& places, Vec3 normal, Vec3 through, double tolerance) {
  std::vector<Vec3> out;
  std::copy_if(places.begin(), places.end(), std::back_inserter(out),
               [&](const Vec3& p) { return std::abs(dot(p - through, normal)) <= tolerance; });
  return out;
}

// The direction of the smallest variance of the points.
Vec3 normal_of(const std::vector<Vec3>& places) {
  const Vec3 middle = mean_of(places);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& place : places) {
    const Eigen::Vector3d d(place.x - middle.x, place.y - middle.y, place.z - middle.z);
    spread += d * d.transpose();
  }
  const Eigen::Vector3d n = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  return {n.x(), n.y(), n.z()};
}

// RANSAC: a plane through three points that contains most points, refined over its inliers.
Vec3 plane_normal(const std::vector<Vec3>& places, std::uint64_t seed) {
  constexpr int kDraws = 400;
  constexpr double kTolerance = 0.015;
  const double tolerance = kTolerance * spread_of(places);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::size_t> any(0, places.size() - 1);
  std::vector<Vec3> best;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Vec3 a = places[any(random)], b = places[any(random)], c = places[any(random)];
    const Vec3 normal = unit(cross(b - a, c - a));
    if (norm(normal) == 0.0) continue;
    auto near = on_plane(places, normal, a, tolerance);
    if (near.size() > best.size()) best = std::move(near);
  }
  return best.size() < 3 ? normal_of(places) : normal_of(best);
}

std::vector<Vec3> some_of(const std::vector<Vec3>& places) {
  constexpr std::size_t kMost = 5000;
  const std::size_t step = places.size() / kMost + 1;
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < places.size(); i += step) out.push_back(places[i]);
  return out;
}

}  // namespace

Transform<SceneFrame, WorldFrame> TableAxes::axes_from_world() const {
  Transform<SceneFrame, WorldFrame> out;
  out.rotation = rotation;
  out.translation_m = translation;
  return out;
}

TableAxes table_axes(const PointCloud& structure, std::span<const vision::CameraPose> poses,
                     std::uint64_t seed) {
  Vec3 forward, up;
  for (const vision::CameraPose& pose : poses) {
    forward += pose.rotate({0, 0, 1});
    up += pose.rotate({0, -1, 0});
  }
  Vec3 z = plane_normal(some_of(structure.places_m), seed);
  if (dot(z, forward) > 0) z = -z;
  // In the plane, away from the cameras; if they look straight down, the up direction of their pictures.
  const auto along = [&](Vec3 v) { return v - dot(v, z) * z; };
  const Vec3 away = along(forward + up);
  const Vec3 y = unit(norm(away) > 0 ? away : along({1, 0, 0}));
  const Vec3 x = cross(y, z);
  return {{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}, {}};
}

}  // namespace palpable::recipes
