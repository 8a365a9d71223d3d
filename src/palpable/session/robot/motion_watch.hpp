// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/robot/robot_drive.hpp"

#include <optional>
#include <string_view>

namespace palpable::session {

/// Compares what a robot is told with what its odometry says. Times are of any steady clock, in seconds. One
/// thread.
class MotionWatch {
 public:
  /// Call it after each command. `told`: the command that was sent last. `measured_m_per_s`: the robot's own
  /// forward speed. `is_followed`: commands were sent, and the connection stands. A sentence when the robot
  /// has to be stopped, once for each time: it moves though it was told to stand for 1.5 s, or its odometry
  /// has neither moved by 5 mm nor turned by 0.01 rad though it was told to move for 2 s.
  std::optional<std::string_view> look(double t_s, const RobotVelocity& told, double measured_m_per_s,
                                       const RobotPose& pose, bool is_followed);

 private:
  bool moves_unasked(double t_s, const RobotVelocity& told, double measured_m_per_s, bool is_followed);
  bool stays(double t_s, const RobotVelocity& told, const RobotPose& pose, bool is_followed);

  double obeys_since_s_ = 0.0;
  double moved_at_s_ = 0.0;
  RobotPose moved_to_;
  bool said_moving_ = false;
};

}  // namespace palpable::session
