// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/motion_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace palpable::session {
namespace {

double angle_between_rad(double from_rad, double to_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * M_PI);
}

/// From when it is told to stand until it counts as moving unasked, seconds: what its driver and its brakes
/// take.
constexpr double kGrace_s = 1.5;
/// Steps in which a pose is followed, and the duration of one: in each the mean of its poses counts, so that
/// the odometry's noise does not.
constexpr std::size_t kSteps = 6;
constexpr double kStep_s = 0.15;

}  // namespace

/// Whether the pose went on from each step to the next, in one direction. A pose that is corrected by a jump
/// changes between two or three steps only; one that trembles returns.
bool MotionWatch::goes_on(double t_s) const {
  constexpr double kMoved_m = 0.02, kMoved_rad = 0.03;
  // Each of the five steps adds at least this share of the whole.
  constexpr double kLeast = 0.05;
  struct Mean {
    double x_m = 0.0, y_m = 0.0, turn_rad = 0.0, count = 0.0;
  };
  std::array<Mean, kSteps> steps{};
  for (const auto& [at_s, pose] : poses_) {
    const double back = std::min((t_s - at_s) / kStep_s, kSteps - 0.5);
    Mean& step = steps[kSteps - 1 - static_cast<std::size_t>(back)];
    step.x_m += pose.x_m;
    step.y_m += pose.y_m;
    step.turn_rad += angle_between_rad(poses_.front().second.heading_rad, pose.heading_rad);
    step.count += 1.0;
  }
  for (Mean& step : steps) {
    if (step.count == 0.0) return false;
    step = {step.x_m / step.count, step.y_m / step.count, step.turn_rad / step.count, step.count};
  }
  const double x_m = steps.back().x_m - steps.front().x_m, y_m = steps.back().y_m - steps.front().y_m;
  const double moved_m = std::hypot(x_m, y_m), turned_rad = steps.back().turn_rad - steps.front().turn_rad;
  // What each step adds, in the direction of the whole.
  double least_m = INFINITY, least_rad = INFINITY;
  for (std::size_t k = 1; k < kSteps; ++k) {
    const Mean &from = steps[k - 1], &to = steps[k];
    least_m = std::min(least_m, ((to.x_m - from.x_m) * x_m + (to.y_m - from.y_m) * y_m) / moved_m);
    least_rad = std::min(least_rad, std::copysign(1.0, turned_rad) * (to.turn_rad - from.turn_rad));
  }
  return (moved_m > kMoved_m && least_m > kLeast * std::max(moved_m, 2.0 * kMoved_m)) ||
         (std::abs(turned_rad) > kMoved_rad &&
          least_rad > kLeast * std::max(std::abs(turned_rad), 2.0 * kMoved_rad));
}

bool MotionWatch::moves_unasked(const Measured& measured) {
  constexpr double kStill_m_per_s = 0.03;
  const double t_s = measured.at_s;
  if (!poses_.empty() && t_s <= poses_.back().first) return false;
  if (std::abs(measured.forward_m_per_s) <= kStill_m_per_s) fast_since_s_ = t_s;
  poses_.emplace_back(t_s, measured.pose);
  while (t_s - poses_.front().first > kSteps * kStep_s) poses_.pop_front();
  if (t_s - told_since_s_ <= kGrace_s) return false;
  if (t_s - fast_since_s_ > kGrace_s || goes_on(t_s)) {
    moving_at_s_ = t_s;
    return !std::exchange(said_moving_, true);
  }
  // It has stood since then: when it moves again, that is said again.
  if (t_s - moving_at_s_ > kGrace_s) said_moving_ = false;
  return false;
}

bool MotionWatch::stays(double t_s, const RobotVelocity& told, const RobotPose& pose, bool is_followed) {
  // Slower commands than these may be below what wheels and odometry can do.
  constexpr double kSlow_m_per_s = 0.05, kSlow_rad_per_s = 0.1;
  constexpr double kLong_s = 2.0, kMoved_m = 0.005, kMoved_rad = 0.01;
  const bool is_told =
      told.forward_m_per_s > kSlow_m_per_s || std::abs(told.turn_rad_per_s) > kSlow_rad_per_s;
  const bool has_moved = std::hypot(pose.x_m - moved_to_.x_m, pose.y_m - moved_to_.y_m) > kMoved_m ||
                         std::abs(angle_between_rad(moved_to_.heading_rad, pose.heading_rad)) > kMoved_rad;
  if (!is_followed || !is_told || has_moved) {
    moved_at_s_ = t_s;
    moved_to_ = pose;
    return false;
  }
  if (t_s - moved_at_s_ <= kLong_s) return false;
  moved_at_s_ = t_s;
  return true;
}

std::optional<RobotEvent> MotionWatch::look(double t_s, const RobotVelocity& told, const Measured& measured,
                                            bool is_followed) {
  if (!is_followed || told != RobotVelocity{}) {
    told_since_s_ = fast_since_s_ = t_s;
    poses_.clear();
    said_moving_ = false;
  } else if (moves_unasked(measured)) {
    return RobotEvent::moved_unasked;
  }
  if (stays(t_s, told, measured.pose, is_followed)) return RobotEvent::stays;
  return std::nullopt;
}

}  // namespace palpable::session
