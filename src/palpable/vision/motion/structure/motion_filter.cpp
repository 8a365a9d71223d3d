// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/motion_filter.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <ceres/rotation.h>

namespace palpable::vision {
namespace {

// Places in the state's error vector.
constexpr int kTurn = 0, kShift = 3, kFocal = 6, kDepths = 7;

Eigen::Vector3d vector_from(Vec3 v) { return {v.x, v.y, v.z}; }

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d out;
  out << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return out;
}

Eigen::Quaterniond turned(const Eigen::Vector3d& by, const Eigen::Quaterniond& rotation) {
  const double angle = by.norm();
  if (angle < 1e-15) return rotation;
  return (Eigen::Quaterniond(Eigen::AngleAxisd(angle, by / angle)) * rotation).normalized();
}

Eigen::Vector3d turn_between(const Eigen::Quaterniond& to, const Eigen::Quaterniond& from) {
  const Eigen::AngleAxisd between(to * from.conjugate());
  // Of the two ways round, the shorter.
  const double angle =
      between.angle() > std::numbers::pi ? between.angle() - 2 * std::numbers::pi : between.angle();
  return angle * between.axis();
}

}  // namespace

struct MotionFilter::State {
  // The line of sight of a point: where it begins in the world, the rotation to the world of the camera that
  // saw it, and where, relative to the given focal length.
  struct Anchor {
    std::size_t track = 0;
    Eigen::Vector3d origin;
    Eigen::Matrix3d world_from_camera;
    Eigen::Vector2d place;
    int misses = 0;
  };

  struct Estimate {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    // The given focal length divided by the one found.
    double inverse_focal = 1.0;
    Eigen::VectorXd inverse_depths;
  };

  // A place that is used: which point, and where it was seen.
  struct Sight {
    int point = 0;
    Eigen::Vector2d seen;
  };

  // Where a point is expected, and how that place depends on the state.
  struct Expected {
    bool in_front = false;
    Eigen::Vector2d place;
    Eigen::Matrix<double, 2, 7> by_camera;
    Eigen::Vector2d by_depth;
  };

  Pinhole camera;
  FilterMotionOptions options;
  Estimate now;
  std::vector<Anchor> anchors;
  Eigen::MatrixXd covariance;

  Eigen::Vector3d direction(const Anchor& anchor, double inverse_focal) const {
    return anchor.world_from_camera *
           Eigen::Vector3d(inverse_focal * anchor.place.x(), inverse_focal * anchor.place.y(), 1);
  }
  Expected expected(const Estimate& at, int point) const;
  Eigen::VectorXd difference(const Estimate& to, const Estimate& from) const;
  void add(Estimate& to, const Eigen::VectorXd& step) const;
  bool correct(std::vector<Sight> sights);
  std::vector<Sight> fitting(const Estimate& at, const std::vector<Sight>& sights,
                             const Eigen::MatrixXd& spread, double gate) const;
};

// The point times its inverse depth, as the camera sees it: R (rho c + d) + rho t.
auto MotionFilter::State::expected(const Estimate& at, int point) const -> Expected {
  const Anchor& anchor = anchors[static_cast<std::size_t>(point)];
  const Eigen::Matrix3d rotation = at.rotation.toRotationMatrix();
  const double depth = at.inverse_depths[point];
  const Eigen::Vector3d turned_point =
      rotation * (depth * anchor.origin + direction(anchor, at.inverse_focal));
  const Eigen::Vector3d h = turned_point + depth * at.translation;
  Expected out;
  out.in_front = h.z() > 1e-6 && depth > 0;
  if (!out.in_front) return out;
  const double fx = camera.fx / at.inverse_focal, fy = camera.fy / at.inverse_focal;
  const Eigen::Vector2d from_centre(fx * h.x() / h.z(), fy * h.y() / h.z());
  out.place = from_centre + Eigen::Vector2d(camera.cx, camera.cy);
  Eigen::Matrix<double, 2, 3> by_h;
  by_h << fx / h.z(), 0, -from_centre.x() / h.z(), 0, fy / h.z(), -from_centre.y() / h.z();
  out.by_camera.block<2, 3>(0, kTurn) = -by_h * cross_matrix(turned_point);
  out.by_camera.block<2, 3>(0, kShift) = depth * by_h;
  out.by_camera.col(kFocal) =
      by_h *
          (rotation * (anchor.world_from_camera * Eigen::Vector3d(anchor.place.x(), anchor.place.y(), 0))) -
      from_centre / at.inverse_focal;
  out.by_depth = by_h * (rotation * anchor.origin + at.translation);
  return out;
}

Eigen::VectorXd MotionFilter::State::difference(const Estimate& to, const Estimate& from) const {
  Eigen::VectorXd out(covariance.rows());
  out.segment<3>(kTurn) = turn_between(to.rotation, from.rotation);
  out.segment<3>(kShift) = to.translation - from.translation;
  out[kFocal] = to.inverse_focal - from.inverse_focal;
  out.tail(from.inverse_depths.size()) = to.inverse_depths - from.inverse_depths;
  return out;
}

void MotionFilter::State::add(Estimate& to, const Eigen::VectorXd& step) const {
  to.rotation = turned(step.segment<3>(kTurn), to.rotation);
  to.translation += step.segment<3>(kShift);
  to.inverse_focal = std::clamp(to.inverse_focal + step[kFocal], 0.3, 3.0);
  to.inverse_depths += step.tail(to.inverse_depths.size());
  // A point stays in front of the camera that saw it first.
  to.inverse_depths = to.inverse_depths.cwiseMax(1e-3);
}

// Sights whose Mahalanobis distance from the expected place is within the gate.
auto MotionFilter::State::fitting(const Estimate& at, const std::vector<Sight>& sights,
                                  const Eigen::MatrixXd& spread, double gate) const -> std::vector<Sight> {
  std::vector<Sight> out;
  for (const Sight& sight : sights) {
    const Expected e = expected(at, sight.point);
    if (!e.in_front) continue;
    const int depth = kDepths + sight.point;
    const Eigen::Matrix<double, 2, 7> cross =
        e.by_camera * spread.topLeftCorner<7, 7>() + e.by_depth * spread.row(depth).head<7>();
    const Eigen::Vector2d with_depth =
        e.by_camera * spread.col(depth).head<7>() + e.by_depth * spread(depth, depth);
    const Eigen::Matrix2d s = cross * e.by_camera.transpose() + with_depth * e.by_depth.transpose() +
                              options.noise_px * options.noise_px * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d off = sight.seen - e.place;
    if (off.dot(s.ldlt().solve(off)) <= gate * gate) out.push_back(sight);
  }
  return out;
}

// An iterated update (Bell & Cathey 1993). The first linearisations weight large errors down (Huber), so that
// wrong places do not move the pose by which they are recognised; the last uses what fits, without weights.
bool MotionFilter::State::correct(std::vector<Sight> sights) {
  const Estimate before = now;
  const Eigen::MatrixXd spread = covariance;
  const auto size = covariance.rows();
  Estimate at = before;
  for (int i = 0; i <= options.iterations; ++i) {
    const bool last = i == options.iterations;
    if (last) sights = fitting(at, sights, covariance, options.gate);
    if (static_cast<int>(sights.size()) < options.least_points) {
      now = before, covariance = spread;
      return false;
    }
    const auto rows = static_cast<Eigen::Index>(2 * sights.size());
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(rows, size);
    Eigen::VectorXd off = Eigen::VectorXd::Zero(rows);
    Eigen::VectorXd noise = Eigen::VectorXd::Constant(rows, options.noise_px * options.noise_px);
    for (std::size_t k = 0; k < sights.size(); ++k) {
      const Expected e = expected(at, sights[k].point);
      if (!e.in_front) continue;
      const auto row = static_cast<Eigen::Index>(2 * k);
      h.block<2, 7>(row, 0) = e.by_camera;
      h.block<2, 1>(row, kDepths + sights[k].point) = e.by_depth;
      off.segment<2>(row) = sights[k].seen - e.place;
      const double size_px = off.segment<2>(row).norm(), robust_px = options.gate * options.noise_px;
      if (!last && i > 0 && size_px > robust_px) noise.segment<2>(row) *= size_px / robust_px;
    }
    const Eigen::MatrixXd to_places = spread * h.transpose();
    Eigen::MatrixXd s = h * to_places;
    s.diagonal() += noise;
    const Eigen::MatrixXd gain = s.llt().solve(to_places.transpose()).transpose();
    Estimate next = before;
    add(next, gain * (off - h * difference(before, at)));
    at = next;
    // Only the last two are used: by the gate, and afterwards. Joseph's form stays positive definite when it
    // is rounded.
    if (i + 1 < options.iterations) continue;
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(size, size) - gain * h;
    covariance = left * spread * left.transpose() + gain * noise.asDiagonal() * gain.transpose();
  }
  now = at;
  for (Anchor& anchor : anchors) ++anchor.misses;
  for (const Sight& sight : sights) anchors[static_cast<std::size_t>(sight.point)].misses = 0;
  return true;
}

MotionFilter::MotionFilter(const VideoCamera& camera, const FilterMotionOptions& options)
    : state_(std::make_unique<State>()) {
  state_->camera = camera.pinhole;
  state_->options = options;
  state_->covariance = Eigen::MatrixXd::Zero(kDepths, kDepths);
  if (!camera.focal_length_known)
    state_->covariance(kFocal, kFocal) = options.focal_spread * options.focal_spread;
}

MotionFilter::~MotionFilter() = default;

void MotionFilter::set_pose(const BundlePose& camera_from_world) {
  double q[4];
  ceres::AngleAxisToQuaternion(camera_from_world.data(), q);
  state_->now.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  state_->now.translation = {camera_from_world[3], camera_from_world[4], camera_from_world[5]};
}

BundlePose MotionFilter::pose() const {
  const State::Estimate& now = state_->now;
  const double q[4] = {now.rotation.w(), now.rotation.x(), now.rotation.y(), now.rotation.z()};
  BundlePose out{};
  ceres::QuaternionToAngleAxis(q, out.data());
  out[3] = now.translation.x(), out[4] = now.translation.y(), out[5] = now.translation.z();
  return out;
}

Pinhole MotionFilter::camera() const {
  Pinhole out = state_->camera;
  out.fx /= state_->now.inverse_focal, out.fy /= state_->now.inverse_focal;
  return out;
}

void MotionFilter::add_point(const TrackPlace& seen, double inverse_depth, double relative_spread) {
  State& s = *state_;
  const Eigen::Matrix3d world_from_camera = s.now.rotation.toRotationMatrix().transpose();
  s.anchors.push_back(
      {seen.track,
       -(world_from_camera * s.now.translation),
       world_from_camera,
       {(seen.place.x - s.camera.cx) / s.camera.fx, (seen.place.y - s.camera.cy) / s.camera.fy},
       0});
  const auto size = s.covariance.rows();
  s.now.inverse_depths.conservativeResize(size + 1 - kDepths);
  s.now.inverse_depths[size - kDepths] = inverse_depth;
  Eigen::MatrixXd larger = Eigen::MatrixXd::Zero(size + 1, size + 1);
  larger.topLeftCorner(size, size) = s.covariance;
  larger(size, size) = relative_spread * relative_spread * inverse_depth * inverse_depth;
  s.covariance = std::move(larger);
}

void MotionFilter::remove_point(std::size_t track) {
  State& s = *state_;
  const auto found = std::find_if(s.anchors.begin(), s.anchors.end(),
                                  [track](const State::Anchor& anchor) { return anchor.track == track; });
  if (found == s.anchors.end()) return;
  const auto index = found - s.anchors.begin();
  s.anchors.erase(found);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < s.covariance.rows(); ++i)
    if (i != kDepths + index) kept.push_back(i);
  s.covariance = Eigen::MatrixXd(s.covariance(kept, kept));
  for (Eigen::Index& i : kept) i -= kDepths;
  kept.erase(kept.begin(), kept.begin() + kDepths);
  s.now.inverse_depths = Eigen::VectorXd(s.now.inverse_depths(kept));
}

std::vector<FilteredPoint> MotionFilter::points() const {
  const State& s = *state_;
  std::vector<FilteredPoint> out;
  for (std::size_t i = 0; i < s.anchors.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const double depth = s.now.inverse_depths[index];
    const Eigen::Vector3d world =
        s.anchors[i].origin + s.direction(s.anchors[i], s.now.inverse_focal) / depth;
    out.push_back({s.anchors[i].track,
                   {world.x(), world.y(), world.z()},
                   std::sqrt(std::max(0.0, s.covariance(kDepths + index, kDepths + index))) / depth,
                   s.anchors[i].misses});
  }
  return out;
}

double MotionFilter::median_inverse_depth() const {
  std::vector<double> inverse;
  for (const FilteredPoint& point : points()) {
    const double z = (state_->now.rotation * vector_from(point.world) + state_->now.translation).z();
    if (z > 0) inverse.push_back(1 / z);
  }
  return inverse.empty() ? 1.0 : quantile_of(inverse, 0.5);
}

// As an exact measurement of the mean, which it already has.
void MotionFilter::fix_scale() {
  Eigen::MatrixXd& p = state_->covariance;
  const auto points = state_->now.inverse_depths.size();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(p.rows());
  mean.tail(points).setConstant(1.0 / static_cast<double>(points));
  const Eigen::VectorXd to_mean = p * mean;
  const double variance = mean.dot(to_mean);
  if (variance > 0) p -= to_mean * to_mean.transpose() / variance;
}

void MotionFilter::predict(int frames) {
  const double turn = state_->options.turn_deg * std::numbers::pi / 180, step = state_->options.step;
  auto diagonal = state_->covariance.diagonal();
  diagonal.segment<3>(kTurn).array() += frames * turn * turn;
  diagonal.segment<3>(kShift).array() += frames * step * step;
}

int MotionFilter::update(std::span<const TrackPlace> seen) {
  State& s = *state_;
  std::vector<State::Sight> sights;
  for (const TrackPlace& place : seen) {
    const auto anchor = std::find_if(s.anchors.begin(), s.anchors.end(),
                                     [&](const State::Anchor& a) { return a.track == place.track; });
    if (anchor != s.anchors.end())
      sights.push_back({static_cast<int>(anchor - s.anchors.begin()), {place.place.x, place.place.y}});
  }
  // A place that even the uncertain prediction does not allow would spoil the first linearisation.
  if (!s.correct(s.fitting(s.now, sights, s.covariance, s.options.gate))) return 0;
  return static_cast<int>(std::count_if(s.anchors.begin(), s.anchors.end(),
                                        [](const State::Anchor& a) { return a.misses == 0; }));
}

}  // namespace palpable::vision
