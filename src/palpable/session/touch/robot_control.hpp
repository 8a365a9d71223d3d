// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/robot/robot_state.hpp"
#include "palpable/session/touch/touch_statistics.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace palpable::session {

/// What a person decides about a robot; any thread.
class RobotControl {
 public:
  RobotControl() = default;
  virtual ~RobotControl() = default;
  RobotControl(const RobotControl&) = delete;
  RobotControl& operator=(const RobotControl&) = delete;

  /// Starts it, once its odometry comes. Before this nothing is sent to it.
  virtual void request_start() = 0;
  virtual void request_stop() = 0;
  virtual void request_mode(RobotMode mode) = 0;
  /// In the mode touch: what is touched. For `near` its arm moves, if it was started.
  virtual void request_view(RobotView view) = 0;
  virtual RobotStatistics statistics() const = 0;
  /// As it was at the last tick of its thread, which comes 50 times a second. Does not wait for the robot.
  virtual RobotState state() const = 0;
  /// The floor around it, as it was seen at most half a second ago; null before any picture. Does not wait
  /// for the robot.
  virtual std::shared_ptr<const RobotFloor> floor() const = 0;
  /// The next sentence on what state() tells as well, if there is a new one.
  virtual std::optional<std::string> state_notice() = 0;
};

/// Whether a word is one for the robot, which is then obeyed: start, stop, drive, look, touch, near, wide.
/// The words of terminal and page.
bool obey(std::string_view word, RobotControl& robot);

}  // namespace palpable::session
