// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/servo/servo_types.hpp"

#include <limits>
#include <string>

namespace palpable::session {

/// CONTRACT's figures for a session that ran (docs/cli.md, a touch without page).
struct TouchStatistics {
  haptics::ServoStatistics servo;
  /// From the reference time given to TouchSession::open to the first force that a hand can feel; NaN if
  /// none.
  double seconds_to_first_force = std::numeric_limits<double>::quiet_NaN();
  std::string device;
  std::string realtime_priority;
  std::string memory_lock;
};

/// {"servo": {"ticks", "rate_hz", …}, "force": …} as CONTRACT states it; one JSON object, numbers only finite
/// or null.
std::string to_json(const TouchStatistics& statistics);

}  // namespace palpable::session
