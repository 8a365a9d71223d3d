// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/ground_axes.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/sculpt/points/plane_fit.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace palpable::recipes {
namespace {

// Median distance of the points from their mean.
double spread_of(const std::vector<Vec3>& places) {
  Vec3 mean;
  for (const Vec3& place : places) mean += place;
  mean = mean / static_cast<double>(places.size());
  std::vector<double> distances;
  for (const Vec3& place : places) distances.push_back(norm(place - mean));
  return quantile_of(distances, 0.5);
}

std::vector<Vec3> on_plane(const std::vector<Vec3>& places, Vec3 normal, Vec3 through, double tolerance) {
  std::vector<Vec3> out;
  std::copy_if(places.begin(), places.end(), std::back_inserter(out),
               [&](const Vec3& p) { return std::abs(dot(p - through, normal)) <= tolerance; });
  return out;
}

// RANSAC: a plane through three points that contains most points, refined over its inliers.
Vec3 ground_normal(const std::vector<Vec3>& places, const GroundAxesOptions& options, std::uint64_t seed) {
  const double tolerance = options.tolerance * spread_of(places);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::size_t> any(0, places.size() - 1);
  std::vector<Vec3> best;
  for (int trial = 0; trial < options.trials; ++trial) {
    const Vec3 a = places[any(random)], b = places[any(random)], c = places[any(random)];
    const Vec3 normal = unit(cross(b - a, c - a));
    if (norm(normal) == 0.0) continue;
    auto near = on_plane(places, normal, a, tolerance);
    if (near.size() > best.size()) best = std::move(near);
  }
  return sculpt::plane_through(best.size() < 3 ? places : best).normal;
}

std::vector<Vec3> some_of(const std::vector<Vec3>& places, std::size_t most) {
  const std::size_t step = places.size() / most + 1;
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < places.size(); i += step) out.push_back(places[i]);
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(GroundAxesOptions& o) {
  return {{"trials", &o.trials, {10, 100000}, "", "Triples of points that are tried as the ground's plane"},
          {"tolerance",
           &o.tolerance,
           {0.001, 0.2},
           "",
           "Distance from a plane within which a point lies on it, share of their spread"},
          {"sampled_points",
           &o.sampled_points,
           {100, 1000000},
           "",
           "Points that these planes are compared with"}};
}

Transform<SceneFrame, WorldFrame> GroundAxes::axes_from_world() const {
  Transform<SceneFrame, WorldFrame> out;
  out.rotation = rotation;
  out.translation_m = translation;
  return out;
}

GroundAxes ground_axes(const PointCloud& structure, std::span<const vision::CameraPose> poses,
                       const GroundAxesOptions& options, std::uint64_t seed) {
  Vec3 forward, up;
  for (const vision::CameraPose& pose : poses) {
    forward += pose.rotate({0, 0, 1});
    up += pose.rotate({0, -1, 0});
  }
  const auto sampled = some_of(structure.places_m, static_cast<std::size_t>(options.sampled_points));
  Vec3 z = ground_normal(sampled, options, seed);
  if (dot(z, forward) > 0) z = -z;
  // In the ground, away from the cameras; if they look straight down, the up direction of their pictures.
  const auto along = [&](Vec3 v) { return v - dot(v, z) * z; };
  const Vec3 away = along(forward + up);
  const Vec3 y = unit(norm(away) > 0 ? away : along({1, 0, 0}));
  const Vec3 x = cross(y, z);
  return {{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}, {}};
}

Vec3 ground_normal(const vision::CameraMotion& motion, const GroundAxesOptions& options, std::uint64_t seed) {
  PointCloud structure;
  for (const vision::StructurePoint& point : motion.points) structure.places_m.push_back(point.position.v);
  std::vector<vision::CameraPose> poses;
  for (const auto& pose : motion.poses)
    if (pose) poses.push_back(*pose);
  if (structure.places_m.empty() || poses.empty()) return {};
  const auto world_from_axes = ground_axes(structure, poses, options, seed).axes_from_world().inverse();
  return world_from_axes.rotate({0, 0, 1});
}

}  // namespace palpable::recipes
