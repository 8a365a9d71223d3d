// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/tick_options.hpp"

#include "palpable/core/text/figure.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace palpable::haptics {
namespace {

/// An option that must be above 0, and at most this.
struct Range {
  const char* words;
  double TickOptions::*value;
  double most;
};

/// May also be infinite: there is no limit.
constexpr Range kLimits[]{// 250 N is what the strongest grounded devices for a hand give.
                          {"greatest force (N)", &TickOptions::max_force_N, 250.0},
                          {"greatest force rate (N/s)", &TickOptions::max_force_rate_N_per_s, 1e5},
                          {"greatest torque rate (Nm/s)", &TickOptions::max_torque_rate_Nm_per_s, 1e5},
                          {"greatest speed (m/s)", &TickOptions::max_speed_m_per_s, 1e3},
                          {"greatest speed of a pointer (m/s)", &TickOptions::max_pointer_speed_m_per_s, 1e3},
                          {"greatest rotation (rad/s)", &TickOptions::max_rotation_rad_per_s, 1e5},
                          {"speed of an impact (m/s)", &TickOptions::impact_speed_m_per_s, 1e3},
                          {"reach in workspaces", &TickOptions::reach_in_workspaces, 1e6}};
constexpr Range kTimes[]{{"time of a cross-fade (s)", &TickOptions::fade_s, 60.0},
                         {"ramp down (s)", &TickOptions::ramp_down_s, 60.0},
                         {"ramp up (s)", &TickOptions::ramp_up_s, 60.0},
                         {"time of a stall (s)", &TickOptions::stall_s, 60.0},
                         {"greatest rise time (s)", &TickOptions::max_rise_time_s, 60.0}};

Error usage(std::string message) { return {ErrorCode::usage, std::move(message), {}}; }

Error out_of(const Range& range) {
  return usage(std::string("the ") + range.words + " must be above 0 and at most " + figure(range.most));
}

bool is_within(double value, const Range& range) { return value > 0.0 && value <= range.most; }

}  // namespace

Result<void> check(const TickOptions& options) {
  for (const Range& range : kLimits)
    if (const double value = options.*range.value;
        !is_within(value, range) && !(std::isinf(value) && value > 0.0))
      return out_of(range);
  for (const Range& range : kTimes)
    if (!is_within(options.*range.value, range)) return out_of(range);
  if (!(options.max_transient_of_force >= 0.0 && options.max_transient_of_force <= 1.0))
    return usage("a contact transient must be 0 to 1 of the greatest force");
  if (options.glitch_readings < 0) return usage("the readings of a glitch must be at least 0");
  return {};
}

}  // namespace palpable::haptics
