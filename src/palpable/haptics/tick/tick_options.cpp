// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/tick_options.hpp"

#include <string>
#include <utility>

namespace palpable::haptics {

Result<void> check(const TickOptions& options) {
  const auto usage = [](std::string message) { return Error{ErrorCode::usage, std::move(message), {}}; };
  const std::pair<const char*, double> above_zero[] = {
      {"greatest force (N)", options.max_force_N},
      {"greatest force rate (N/s)", options.max_force_rate_N_per_s},
      {"greatest torque rate (Nm/s)", options.max_torque_rate_Nm_per_s},
      {"speed of an impact (m/s)", options.impact_speed_m_per_s},
      {"time of a cross-fade (s)", options.fade_s},
      {"ramp down (s)", options.ramp_down_s},
      {"ramp up (s)", options.ramp_up_s},
      {"greatest speed (m/s)", options.max_speed_m_per_s},
      {"greatest speed of a pointer (m/s)", options.max_pointer_speed_m_per_s},
      {"greatest rotation (rad/s)", options.max_rotation_rad_per_s},
      {"reach in workspaces", options.reach_in_workspaces},
      {"time of a stall (s)", options.stall_s},
      {"greatest rise time (s)", options.max_rise_time_s}};
  for (const auto& [name, value] : above_zero)
    if (!(value > 0.0)) return usage("the " + std::string(name) + " must be above 0");
  if (!(options.max_transient_of_force >= 0.0 && options.max_transient_of_force <= 1.0))
    return usage("a contact transient must be 0 to 1 of the greatest force");
  if (options.glitch_readings < 0) return usage("the readings of a glitch must be at least 0");
  return {};
}

}  // namespace palpable::haptics
