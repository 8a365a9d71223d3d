// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/servo/latency_recorder.hpp"
#include "palpable/haptics/tick/servo_types.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

/// What was done with a robot's arm.
struct ArmStatistics {
  std::uint64_t commands = 0;
  std::uint64_t near_views = 0;
};

/// What was sent to a robot.
struct RobotStatistics {
  std::uint64_t commands = 0;
  /// Those that were not zero.
  std::uint64_t moving_commands = 0;
  bool is_started = false;
  /// Sounds that had a direction.
  std::uint64_t sounds = 0;
  /// From when a picture was taken to the newest odometry when it had arrived, both by the robot's clock.
  haptics::LatencySummary picture_age;
  /// nullopt: it has none.
  std::optional<ArmStatistics> arm = {};
};

/// What a live touch remembers (live_memory.hpp).
struct MemoryStatistics {
  /// Share of the newest surface that the camera does not see now.
  double share = 0.0;
  double map_mib = 0.0;
  /// Frames whose place was not found.
  std::uint64_t lost = 0;
};

/// How a live touch kept up with its source.
struct LiveStatistics {
  /// Frames that arrived, and those of them that were never felt.
  std::uint64_t frames = 0;
  std::uint64_t dropped = 0;
  /// Frames a second that were felt.
  double fps = std::numeric_limits<double>::quiet_NaN();
  /// From the arrival of a frame to the first tick that knows it, of the frames that were felt.
  haptics::LatencySummary latency;
  /// Age of the newest felt frame; NaN if none was felt.
  double stale_s = std::numeric_limits<double>::quiet_NaN();
  /// Of a robot's camera.
  std::optional<RobotStatistics> robot = {};
  /// nullopt: nothing is remembered.
  std::optional<MemoryStatistics> memory;
};

/// Statistics of a touch without page (docs/cli.md).
struct TouchStatistics {
  haptics::ServoStatistics servo;
  /// Time from `begin_ns` of TouchSession::open() until the first scene could be touched.
  double seconds_to_scene = std::numeric_limits<double>::quiet_NaN();
  /// The same to the first force that a hand can feel; NaN if there was
  /// none.
  double seconds_to_first_force = std::numeric_limits<double>::quiet_NaN();
  std::string device;
  std::string realtime_priority;
  std::string memory_lock;
  /// Of a touch of a live source.
  std::optional<LiveStatistics> live;
  /// Of the hands after the first.
  std::vector<TouchStatistics> further_hands;
};

/// One JSON object {"servo": {"ticks", "rate_hz", …}, "force": …} (docs/cli.md); values that are not finite
/// are null.
std::string to_json(const TouchStatistics& statistics);

}  // namespace palpable::session
