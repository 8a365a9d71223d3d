// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/page/protocol.gen.hpp"
#include "palpable/session/robot/robot_state.hpp"

#include <chrono>
#include <optional>

namespace palpable::page {

/// A robot's state as the pages are told of it.
protocol::Robot page_robot(const session::RobotState& state);

protocol::RobotFloor page_floor(const session::RobotFloor& floor);

/// Keeps the messages on a robot few: a change is told at once, figures that go on changing (battery, age of
/// the picture) at most twice a second. One thread.
class RobotNews {
 public:
  /// What is to be shown at `now`: `newest`, or what was shown before.
  const protocol::Robot& take(const protocol::Robot& newest, std::chrono::steady_clock::time_point now);

 private:
  std::optional<protocol::Robot> shown_;
  std::chrono::steady_clock::time_point shown_at_;
};

}  // namespace palpable::page
