// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <limits>

namespace palpable::haptics {

enum class Passivity { observe, control };

/// Whether ReturnLimit bounds what a contact returns. `free` is for measurements of what a law's springs and
/// dampers return by themselves.
enum class Returns { limited, free };

/// Limits of a tick. All times and rates are above 0.
struct TickOptions {
  /// Force cap, > 0; limited to the device's greatest force.
  double max_force_N = std::numeric_limits<double>::infinity();
  /// Of the motors at the first tick, 0 to 1 (HeatBudget::heat()).
  double heat = 0.0;
  /// Limit of growth only; a decrease is never delayed. The default does not limit a wall of 500 N/m that is
  /// hit at 0.6 m/s.
  double max_force_rate_N_per_s = 300.0;
  /// The same for torque: 0.1 m times the force's limit.
  double max_torque_rate_Nm_per_s = 30.0;
  Passivity passivity = Passivity::control;
  Returns returns = Returns::limited;
  /// The amplitude of a contact transient is at most this fraction of the device's greatest force, 0 to 1;
  /// and the least speed at which a contact counts as an impact.
  double max_transient_of_force = 0.25;
  double impact_speed_m_per_s = 0.02;
  /// Duration of the cross-fade from one scene to the next.
  double fade_s = 0.15;
  /// Ramp times: to zero at a fault or pause, and back afterwards.
  double ramp_down_s = 0.02;
  double ramp_up_s = 0.25;
  /// The ramp of a touch that begins in contact loads the spring (RiseLimit::Input::loads). Not at either end
  /// of a link: a shared device counts what its forces give, and what a ramp brought would end them.
  bool ramp_loads = true;
  /// A faster movement since the last valid reading is not a hand's: the reading is not rendered, and if it
  /// persists a new touch begins. The second value is for devices without motors, whose probe may jump.
  double max_speed_m_per_s = 2.5;
  double max_pointer_speed_m_per_s = 8.0;
  /// The same for the rotation of a handle.
  double max_rotation_rad_per_s = 60.0;
  /// Number of consecutive implausible readings that are treated as a glitch.
  int glitch_readings = 2;
  /// A reading farther out than this many workspace sizes is implausible.
  double reach_in_workspaces = 10.0;
  /// A tick that follows the previous one after more than this time is a stall: the watchdog has written zero
  /// force, and the force rises from zero.
  double stall_s = 0.005;
  /// The rise in one tick is limited to that of this time, however late the tick is. ServoLoop sets it from
  /// its rate (tick_options()).
  double max_rise_time_s = 0.0015;
};

/// The shortest window of an estimated velocity, s: three quarters of a period.
inline double shortest_window_s(const TickOptions& options) { return 0.5 * options.max_rise_time_s; }

/// How fast a surface that changes, or comes under a hand by its ramp, lifts the hand, m/s at the device; no
/// change takes longer.
inline constexpr double kLift_m_per_s = 0.03;
inline constexpr double kLongestLift_s = 1.0;

/// Errors: usage for the first value that is not above 0, is NaN, or is far beyond what any device and hand
/// need (a finite force above 250 N, a time above 60 s).
Result<void> check(const TickOptions& options);

}  // namespace palpable::haptics
