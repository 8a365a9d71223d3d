// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/motion_watch.hpp"

#include <cmath>
#include <utility>

namespace palpable::session {

bool MotionWatch::moves_unasked(double t_s, const RobotVelocity& told, double measured_m_per_s,
                                bool is_followed) {
  constexpr double kLong_s = 1.5, kStill_m_per_s = 0.03;
  if (is_followed && told == RobotVelocity{} && std::abs(measured_m_per_s) > kStill_m_per_s)
    return t_s - obeys_since_s_ > kLong_s && !std::exchange(said_moving_, true);
  obeys_since_s_ = t_s;
  said_moving_ = false;
  return false;
}

bool MotionWatch::stays(double t_s, const RobotVelocity& told, const RobotPose& pose, bool is_followed) {
  // Slower commands than these may be below what wheels and odometry can do.
  constexpr double kSlow_m_per_s = 0.05, kSlow_rad_per_s = 0.1;
  constexpr double kLong_s = 2.0, kMoved_m = 0.005, kMoved_rad = 0.01;
  const bool is_told =
      told.forward_m_per_s > kSlow_m_per_s || std::abs(told.turn_rad_per_s) > kSlow_rad_per_s;
  const bool has_moved =
      std::hypot(pose.x_m - moved_to_.x_m, pose.y_m - moved_to_.y_m) > kMoved_m ||
      std::abs(std::remainder(pose.heading_rad - moved_to_.heading_rad, 2.0 * M_PI)) > kMoved_rad;
  if (!is_followed || !is_told || has_moved) {
    moved_at_s_ = t_s;
    moved_to_ = pose;
    return false;
  }
  if (t_s - moved_at_s_ <= kLong_s) return false;
  moved_at_s_ = t_s;
  return true;
}

std::optional<std::string_view> MotionWatch::look(double t_s, const RobotVelocity& told,
                                                  double measured_m_per_s, const RobotPose& pose,
                                                  bool is_followed) {
  if (moves_unasked(t_s, told, measured_m_per_s, is_followed))
    return "The robot moves, though it is told to stand: use its own emergency stop.";
  if (stays(t_s, told, pose, is_followed))
    return "The robot is stopped: it was told to move, and its odometry says that it stands. It may be "
           "blocked, or its odometry hangs.";
  return std::nullopt;
}

}  // namespace palpable::session
