// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace palpable::vision {
namespace {

struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

Ray ray_of(const PosedObservation& observation, const Pinhole& camera) {
  const CameraPose pose = camera_pose(observation.pose);
  const Vec3 direction = unit(pose.rotate(
      {(observation.place.x - camera.cx) / camera.fx, (observation.place.y - camera.cy) / camera.fy, 1.0}));
  const Vec3& origin = pose.translation_m;
  return {{origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}};
}

}  // namespace

std::optional<std::array<double, 3>> triangulated_point(std::span<const PosedObservation> observations,
                                                        const Pinhole& camera,
                                                        const TriangulationOptions& options) {
  if (observations.size() < 2) return std::nullopt;
  std::vector<Ray> rays;
  for (const PosedObservation& observation : observations) rays.push_back(ray_of(observation, camera));
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double least_cosine = 1.0;
  for (const Ray& ray : rays) {
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose();
    normal += across;
    right += across * ray.origin;
    least_cosine = std::min(least_cosine, ray.direction.dot(rays.front().direction));
  }
  if (least_cosine > std::cos(options.least_angle_deg * std::numbers::pi / 180)) return std::nullopt;
  const Eigen::Vector3d p = normal.ldlt().solve(right);
  const std::array<double, 3> point{p.x(), p.y(), p.z()};
  const bool fits =
      p.allFinite() && std::all_of(observations.begin(), observations.end(), [&](const PosedObservation& s) {
        return projection_error_px(camera, s.pose, point, s.place) <= options.outlier_px;
      });
  return fits ? std::optional(point) : std::nullopt;
}

}  // namespace palpable::vision
