// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/tick/servo_types.hpp"
#include "palpable/session/touch/live_statistics.hpp"

#include <limits>
#include <optional>
#include <string>

namespace palpable::session {

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
};

/// One JSON object {"servo": {"ticks", "rate_hz", …}, "force": …} (docs/cli.md); values that are not finite
/// are null.
std::string to_json(const TouchStatistics& statistics);

}  // namespace palpable::session
