// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/alignment.hpp"

#include "palpable/core/check.hpp"
#include "palpable/vision/mapping/pixel_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace palpable::vision {
namespace {

using Pose = WorldPose;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using RowMajor6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// A point of the picture in the camera's frame, its surface's unit normal towards the camera, and the noise
/// of its distance from that surface.
struct Reading {
  Vec3 point;
  Vec3 normal;
  double deviation_m;
};

Vec3 normal_of(const PixelPlane& plane, const Pinhole& camera, int x, int y) {
  const double across = static_cast<double>(plane.by_x), down = static_cast<double>(plane.by_y);
  const Vec3 away{camera.fx * across, camera.fy * down,
                  static_cast<double>(plane.inverse) - (x - camera.cx) * across - (y - camera.cy) * down};
  return (-1.0 / norm(away)) * away;
}

std::vector<Reading> readings_of(const PosedDepth& frame, const DepthNoise& noise, double far_m, int most) {
  const Raster<PixelPlane> planes = pixel_planes(frame.depth_m, frame.camera);
  const int step =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(frame.depth_m.count()) / most)));
  constexpr float kLeastFacing = 0.2F;
  std::vector<Reading> readings;
  for (int y = step / 2; y < frame.camera.height; y += step)
    for (int x = step / 2; x < frame.camera.width; x += step) {
      const float z = frame.depth_m(x, y);
      const PixelPlane& plane = planes(x, y);
      if (!(z <= far_m) || plane.facing < kLeastFacing) continue;
      const Vec3 ray{(x - frame.camera.cx) / frame.camera.fx, (y - frame.camera.cy) / frame.camera.fy, 1.0};
      readings.push_back({static_cast<double>(z) * ray, normal_of(plane, frame.camera, x, y),
                          static_cast<double>(noise.deviation_m(z) * plane.facing)});
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
Vector6 between(const Pose& a, const Pose& b) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> ra(a.rotation.data());
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rb(b.rotation.data());
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(rb * ra.transpose()));
  const Vec3 t = b.translation_m - a.translation_m;
  Vector6 by;
  by << turn.angle() * turn.axis(), t.x, t.y, t.z;
  return by;
}

/// The normal equations of one step, what of `a` the noise of the surfaces' normals alone would make, and the
/// share of readings near the map's surface.
struct Equations {
  Matrix6 a = Matrix6::Zero();
  Matrix6 noise = Matrix6::Zero();
  Vector6 b = Vector6::Zero();
  double matched = 0.0;
  /// The mean robust cost of a reading where the map is known; as AlignedPose::cost.
  double cost = 0.0;
};

Eigen::Matrix3d cross_matrix(Vec3 v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0;
  return m;
}

Equations equations(const SurfaceMap& map, const std::vector<Reading>& readings, const Pose& pose,
                    double independent) {
  Equations e;
  const double map_noise_m = 0.1 * map.options().voxel_m;
  const double limit_m = 0.95 * map.truncation_m();
  std::size_t matched = 0, known = 0;
  double cost = 0.0;
  double disagreement = 0.0, weights = 0.0;
  for (const Reading& reading : readings) {
    const Vec3 arm = pose.rotate(reading.point);
    const auto sample = map.sample({pose.translation_m + arm});
    if (!sample) continue;
    ++known;
    const double deviation = std::hypot(reading.deviation_m, map_noise_m);
    // The robust weight of Tukey's biweight, wide enough for a first pose that is a truncation off.
    const double far = sample->distance_m / map.truncation_m();
    const double near = std::max(0.0, 1.0 - far * far);
    cost += (1.0 - near * near * near) / (deviation * deviation);
    if (std::abs(sample->distance_m) > limit_m) continue;
    const double steep = norm(sample->gradient);
    if (!(steep > 0.3)) continue;
    ++matched;
    const Vec3 n = sample->gradient;
    const double weight = near * near / (deviation * deviation);
    const Vec3 torque = cross(arm, n);
    Vector6 j;
    j << torque.x, torque.y, torque.z, n.x, n.y, n.z;
    e.a += weight * j * j.transpose();
    e.b -= weight * sample->distance_m * j;
    const Vec3 unit = (1.0 / steep) * n;
    // An edge is no noise.
    const double off = squared_norm(unit - pose.rotate(reading.normal));
    if (off < 0.25) disagreement += weight * off, weights += weight;
    Eigen::Matrix<double, 6, 3> k;
    k << cross_matrix(arm), Eigen::Matrix3d::Identity();
    e.noise += weight * k * k.transpose();
  }
  if (weights > 0.0) e.noise *= 0.25 * disagreement / weights;
  // 1 if they are off by their noise: near^3 is about 1 - 3 far^2.
  const double unit = 3.0 / (map.truncation_m() * map.truncation_m());
  e.cost = cost / std::max(1.0, static_cast<double>(known)) / unit;
  e.matched = readings.empty() ? 0.0 : static_cast<double>(matched) / static_cast<double>(readings.size());
  const double worth = std::min(1.0, independent / std::max(1.0, static_cast<double>(matched)));
  e.a *= worth;
  e.b *= worth;
  e.noise *= worth;
  return e;
}

/// What these equations say beside an expected pose, whose errors are `root` times independent ones of
/// variance 1: the step to the most likely pose, and what the picture alone says.
struct Solution {
  Vector6 step;
  Matrix6 information;
};

/// `off`: from the pose of the equations to the expected one. Directions of which the picture says no more
/// than the noise of normals would are left to the expected pose.
Solution solution_of(const Equations& e, const Matrix6& root, const Vector6& off) {
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(root.transpose() * e.a * root);
  const Matrix6 noise = root.transpose() * e.noise * root;
  const Matrix6 back = root.triangularView<Eigen::Lower>().solve(Matrix6::Identity());
  const Vector6 b = root.transpose() * e.b, expected = back * off;
  constexpr double kAboveNoise = 3.0;
  Solution solution{Vector6::Zero(), Matrix6::Zero()};
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Vector6 v = eigen.eigenvectors().col(i);
    const double by_noise = v.dot(noise * v);
    const bool is_known = eigen.eigenvalues()[i] > kAboveNoise * by_noise;
    const double known = is_known ? eigen.eigenvalues()[i] - by_noise : 0.0;
    solution.step += v.dot(is_known ? Vector6(b + expected) : expected) / (known + 1.0) * v;
    const Vector6 along = back.transpose() * v;
    solution.information += known * along * along.transpose();
  }
  solution.step = root * solution.step;
  return solution;
}

/// Where the steps from a start end.
struct Settled {
  Pose pose;
  Matrix6 information = Matrix6::Zero();
  double matched = 0.0, cost = 0.0;
  bool is_valid = false;
};

Settled settled(const SurfaceMap& map, const std::vector<Reading>& readings, const Pose& start,
                const Pose& expected, const Matrix6& root, const AlignmentOptions& options) {
  Settled found{start};
  constexpr double kConvergedStep = 1e-5;
  for (int k = 0; k < options.iterations; ++k) {
    const Equations e = equations(map, readings, found.pose, options.independent_readings);
    found.matched = e.matched;
    found.cost = e.cost;
    if (e.matched < options.least_matched) return found;
    const Solution solution = solution_of(e, root, between(found.pose, expected));
    if (!solution.step.allFinite()) return found;
    found.pose = moved(found.pose, solution.step);
    found.information = solution.information;
    if (solution.step.norm() < kConvergedStep) break;
  }
  found.is_valid = true;
  return found;
}

Matrix6 root_of(const PoseMatrix& covariance) {
  const Eigen::LLT<Matrix6> cholesky(Matrix6(Eigen::Map<const RowMajor6>(covariance.data())));
  PALPABLE_CHECK(cholesky.info() == Eigen::Success);
  return cholesky.matrixL();
}

AlignedPose result_of(const Settled& found) {
  AlignedPose result{found.pose, found.matched, true, {}, found.cost};
  Eigen::Map<RowMajor6>(result.information.data()) = found.information;
  return result;
}

}  // namespace

WorldPose moved_by(const WorldPose& pose, const PoseError& motion) {
  return moved(pose, Eigen::Map<const Vector6>(motion.data()));
}

PoseError motion_between(const WorldPose& from, const WorldPose& to) {
  PoseError motion;
  Eigen::Map<Vector6>(motion.data()) = between(from, to);
  return motion;
}

PoseMatrix independent_errors(Vec3 turn_rad, Vec3 position_m) {
  const std::array<double, 6> deviation{turn_rad.x,   turn_rad.y,   turn_rad.z,
                                        position_m.x, position_m.y, position_m.z};
  PoseMatrix covariance{};
  for (std::size_t i = 0; i < 6; ++i) covariance[7 * i] = deviation[i] * deviation[i];
  return covariance;
}

AlignedPose aligned(const SurfaceMap& map, const PosedDepth& frame, const PoseMatrix& expected,
                    const AlignmentOptions& options) {
  AlignedPose result{frame.world_from_camera};
  if (map.empty()) return result;
  const auto readings = readings_of(frame, map.options().noise, map.options().far_m, options.readings);
  const Matrix6 root = root_of(expected);
  const Settled found =
      settled(map, readings, frame.world_from_camera, frame.world_from_camera, root, options);
  result.matched = found.matched;
  result.cost = found.cost;
  // Beyond this the expected pose was not what it was said to be, or the solution is another place's.
  constexpr double kPlausible = 5.0;
  const Vector6 correction = between(frame.world_from_camera, found.pose);
  const bool is_plausible = root.triangularView<Eigen::Lower>().solve(correction).norm() < kPlausible;
  return found.is_valid && is_plausible ? result_of(found) : result;
}

std::optional<AlignedPose> relocated(const SurfaceMap& map, const PosedDepth& frame, const AlignedPose& found,
                                     const PoseMatrix& drift, const AlignmentOptions& options) {
  const Eigen::Map<const RowMajor6> covariance(drift.data());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
      Eigen::Matrix3d(covariance.bottomRightCorner<3, 3>()));
  const double deviation_m = std::sqrt(eigen.eigenvalues()[2]);
  constexpr double kSure = 0.2, kStep = 0.4, kFar = 3.0, kWell = 1.0;
  constexpr int kMost = 8;
  if (!(deviation_m > kSure * map.truncation_m()) || found.cost < kWell) return std::nullopt;
  const double step_m = kStep * map.truncation_m();
  const int steps = std::min(kMost, static_cast<int>(kFar * deviation_m / step_m));
  // What else is expected if its place is this far off.
  const Vector6 along = covariance.rightCols<3>() * eigen.eigenvectors().col(2) / (deviation_m * deviation_m);
  const auto readings = readings_of(frame, map.options().noise, map.options().far_m, options.readings);
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  const Pose& expected = found.world_from_camera;
  for (int k = -steps; k <= steps; ++k) {
    const Equations e =
        equations(map, readings, moved(expected, k * step_m * along), options.independent_readings);
    if (e.matched < options.least_matched || e.cost >= least) continue;
    best = k;
    least = e.cost;
  }
  if (best == 0) return std::nullopt;
  const Settled other =
      settled(map, readings, moved(expected, best * step_m * along), expected, root_of(drift), options);
  constexpr double kMuch = 0.6;
  if (!other.is_valid || other.cost > kMuch * found.cost) return std::nullopt;
  return result_of(other);
}

}  // namespace palpable::vision
