// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace palpable::haptics {

enum class Passivity { observe, control };

/// Limits of a tick.
struct TickOptions {
  /// Lowered to the device's own; > 0.
  double max_force_N = std::numeric_limits<double>::infinity();
  /// Growth only; release is never delayed. The default lets a wall of 500 N/m met at 0.6 m/s through.
  double max_force_rate_N_per_s = 300.0;
  /// The same of a torque: 0.1 m times the force's.
  double max_torque_rate_Nm_per_s = 30.0;
  Passivity passivity = Passivity::control;
  /// A contact transient's amplitude is this part of the device's greatest force at most; and the speed from
  /// which a contact is an impact.
  double max_transient_of_force = 0.25;
  double impact_speed_m_per_s = 0.02;
  /// One scene gives way to the next in this time.
  double fade_s = 0.15;
  /// A fault or pause takes the force to zero in the first time, the end of it brings it back in the second.
  double ramp_down_s = 0.02;
  double ramp_up_s = 0.25;
  /// A reading that moved faster than this since the last good one is not a hand's: it is not rendered, and
  /// if it lasts it begins a new touch. The second is for devices without motors, whose probe may be
  /// anywhere.
  double max_speed_m_per_s = 2.5;
  double max_pointer_speed_m_per_s = 8.0;
  /// A handle that turned faster is likewise no hand's.
  double max_turn_rad_per_s = 60.0;
  /// So many implausible readings in a row are taken for a glitch that may pass.
  int glitch_readings = 2;
  /// A reading further out than this many workspaces is no reading.
  double reach_in_workspaces = 10.0;
  /// A tick that comes later than this after the one before: by then the watchdog has written zero force, and
  /// the force begins anew from there.
  double stall_s = 0.005;
  /// No tick's force grows by more than this time allows, however late the tick is.
  double max_rise_time_s = 0.0015;
};

}  // namespace palpable::haptics
