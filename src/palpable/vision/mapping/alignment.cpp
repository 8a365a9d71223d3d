// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/alignment.hpp"

#include "palpable/vision/mapping/pixel_planes.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace palpable::vision {
namespace {

using Pose = Transform<WorldFrame, CameraFrame>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A point of the picture in the camera's frame, and the noise of its distance from its surface.
struct Reading {
  Vec3 point;
  double deviation_m;
};

std::vector<Reading> readings_of(const PosedDepth& frame, const DepthNoise& noise, double far_m, int most) {
  const Raster<PixelPlane> planes = pixel_planes(frame.depth_m, frame.camera);
  const int step =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(frame.depth_m.count()) / most)));
  constexpr float kLeastFacing = 0.2F;
  std::vector<Reading> readings;
  for (int y = step / 2; y < frame.camera.height; y += step)
    for (int x = step / 2; x < frame.camera.width; x += step) {
      const float z = frame.depth_m(x, y);
      if (!(z <= far_m) || planes(x, y).facing < kLeastFacing) continue;
      const Vec3 ray{(x - frame.camera.cx) / frame.camera.fx, (y - frame.camera.cy) / frame.camera.fy, 1.0};
      readings.push_back(
          {static_cast<double>(z) * ray, static_cast<double>(noise.deviation_m(z) * planes(x, y).facing)});
    }
  return readings;
}

/// `pose` after a small motion: (turn, position), the turn about the camera.
Pose moved(const Pose& pose, const Vector6& by) {
  const Eigen::Vector3d turn = by.head<3>();
  const double angle = turn.norm();
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  if (angle > 0.0) r = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> before(pose.rotation.data());
  Pose after = pose;
  // Through a quaternion, so that the matrix stays a rotation.
  const Eigen::Matrix3d turned =
      Eigen::Quaterniond(Eigen::Matrix3d(r * before)).normalized().toRotationMatrix();
  for (std::size_t i = 0; i < 9; ++i)
    after.rotation[i] = turned(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
  after.translation_m += Vec3{by[3], by[4], by[5]};
  return after;
}

/// The motion from `a` to `b`, as moved() takes it.
Vector6 motion_between(const Pose& a, const Pose& b) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> ra(a.rotation.data());
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rb(b.rotation.data());
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(rb * ra.transpose()));
  const Vec3 t = b.translation_m - a.translation_m;
  Vector6 by;
  by << turn.angle() * turn.axis(), t.x, t.y, t.z;
  return by;
}

/// The normal equations of one step, and the share of readings near the map's surface.
struct Equations {
  Matrix6 a = Matrix6::Zero();
  Vector6 b = Vector6::Zero();
  double matched = 0.0;
};

Equations equations(const SurfaceMap& map, const std::vector<Reading>& readings, const Pose& pose,
                    double independent) {
  Equations e;
  const double map_noise_m = 0.1 * map.options().voxel_m;
  const double limit_m = 0.95 * map.truncation_m();
  std::size_t matched = 0;
  for (const Reading& reading : readings) {
    const Vec3 arm = pose.rotate(reading.point);
    const auto sample = map.sample({pose.translation_m + arm});
    if (!sample || std::abs(sample->distance_m) > limit_m) continue;
    const double steep = norm(sample->gradient);
    if (!(steep > 0.3)) continue;
    ++matched;
    const Vec3 n = sample->gradient;
    const double deviation = std::hypot(reading.deviation_m, map_noise_m);
    // The robust weight of Tukey's biweight, wide enough for a first pose that is a truncation off.
    const double far = sample->distance_m / map.truncation_m();
    const double robust = (1.0 - far * far) * (1.0 - far * far);
    const double weight = robust / (deviation * deviation);
    const Vec3 torque = cross(arm, n);
    Vector6 j;
    j << torque.x, torque.y, torque.z, n.x, n.y, n.z;
    e.a += weight * j * j.transpose();
    e.b -= weight * sample->distance_m * j;
  }
  e.matched = readings.empty() ? 0.0 : static_cast<double>(matched) / static_cast<double>(readings.size());
  const double worth = std::min(1.0, independent / std::max(1.0, static_cast<double>(matched)));
  e.a *= worth;
  e.b *= worth;
  return e;
}

}  // namespace

AlignedPose aligned(const SurfaceMap& map, const PosedDepth& frame, const PoseDeviation& deviation,
                    const AlignmentOptions& options) {
  AlignedPose result{frame.world_from_camera, 0.0, false};
  if (map.empty()) return result;
  const auto readings = readings_of(frame, map.options().noise, map.options().far_m, options.readings);
  Vector6 prior;
  prior.head<3>().setConstant(1.0 / (deviation.turn_rad * deviation.turn_rad));
  prior.tail<3>().setConstant(1.0 / (deviation.position_m * deviation.position_m));
  Pose pose = frame.world_from_camera;
  constexpr double kStill = 1e-5;
  for (int k = 0; k < options.iterations; ++k) {
    Equations e = equations(map, readings, pose, options.independent_readings);
    result.matched = e.matched;
    if (e.matched < options.least_matched) return result;
    e.a.diagonal() += prior;
    e.b += prior.cwiseProduct(motion_between(pose, frame.world_from_camera));
    const Vector6 step = e.a.ldlt().solve(e.b);
    if (!step.allFinite()) return result;
    pose = moved(pose, step);
    if (step.norm() < kStill) break;
  }
  // Beyond this the expected pose was not what it was said to be, or the solution is another place's.
  constexpr double kPlausible = 5.0;
  const Vector6 correction = motion_between(frame.world_from_camera, pose);
  if (correction.head<3>().norm() > kPlausible * deviation.turn_rad ||
      correction.tail<3>().norm() > kPlausible * deviation.position_m)
    return result;
  result.world_from_camera = pose;
  result.found = true;
  return result;
}

}  // namespace palpable::vision
