// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/robot/robot_state.hpp"

#include <deque>
#include <optional>
#include <utility>

namespace palpable::session {

/// Compares what a robot is told with what its odometry says. Times are of any steady clock, in seconds. One
/// thread.
class MotionWatch {
 public:
  /// A robot's pose and its own forward speed, and when it measured them.
  struct Measured {
    double at_s = 0.0;
    RobotPose pose;
    double forward_m_per_s = 0.0;
  };
  /// Call it after each command. `told`: the command that was sent last. `is_followed`: commands were sent,
  /// and the connection stands. An event when the robot has to be stopped, once for each time. moved_unasked:
  /// since 1.5 s it is told to stand, and its speed was not zero all that time, or its pose went on steadily
  /// in the last 0.9 s, by at least 2 cm or 0.03 rad; this needs at least seven poses a second. Poses count
  /// for when they were measured, so that odometry that comes late is no movement after a stop. stays: its
  /// odometry has neither moved by 5 mm nor turned by 0.01 rad though it was told to move for 2 s.
  std::optional<RobotEvent> look(double t_s, const RobotVelocity& told, const Measured& measured,
                                 bool is_followed);

 private:
  bool moves_unasked(const Measured& measured);
  bool goes_on(double t_s) const;
  bool stays(double t_s, const RobotVelocity& told, const RobotPose& pose, bool is_followed);

  /// Since then it has been told to stand, and since then its own speed has not been zero.
  double told_since_s_ = 0.0, fast_since_s_ = 0.0;
  /// While it is told to stand: the poses of the last 0.9 s.
  std::deque<std::pair<double, RobotPose>> poses_;
  double moved_at_s_ = 0.0;
  RobotPose moved_to_;
  bool said_moving_ = false;
  /// When it moved unasked last.
  double moving_at_s_ = 0.0;
};

}  // namespace palpable::session
