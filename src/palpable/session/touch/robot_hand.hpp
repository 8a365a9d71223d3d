// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/law_parameters.hpp"
#include "palpable/session/robot/robot_drive.hpp"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>

namespace palpable::session {

class TouchSession;

/// The touch whose hand drives a robot: where the hand is, and the law of the robot's mode. begin() and end()
/// by the thread that runs the touch, the others by any; follow_law() and now() by one.
class RobotHand {
 public:
  /// Where it is, if a tick of the servo says so that was not seen before.
  struct Now {
    std::optional<DriveHand> at;
    /// Nobody holds it.
    bool is_released = false;
  };

  void begin(TouchSession& session);
  /// Nobody uses the touch once this has returned, except who asked for it by touch() before.
  void end();
  /// Null before begin() and after end().
  TouchSession* touch() const { return session_; }
  void change_mode(RobotMode mode);
  /// The law of the mode, once after each change: the touch's own in the mode touch, else the hand rolls.
  void follow_law();
  Now now();

 private:
  std::mutex using_session_;
  std::atomic<TouchSession*> session_{nullptr};
  std::atomic<RobotMode> mode_{RobotMode::drive};
  std::atomic<bool> law_is_set_{true};
  haptics::LawParameters touch_law_;
  std::uint64_t last_tick_ = 0;
};

}  // namespace palpable::session
