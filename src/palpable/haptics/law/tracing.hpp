// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/law.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/contours/boundary_map.hpp"

#include <memory>

namespace palpable::haptics {

extern const LawDescription kTracingLaw;

struct TracingParameters {
  /// F_m of eq. 8: the force when moving along a boundary of full strength. 0 … 5 N.
  double force_N = 1.0;
  /// epsilon of eqs 5–6, the distance over which the hand's direction is estimated: several times the
  /// device's resolution. 10 um … 5 mm.
  double direction_m = 0.0005;
  /// Viscous damping of all motion, N·s/m.
  double damping_Ns_per_m = 0.2;
  /// Stiffness of the weak wall at z = 0 that keeps a hand with three axes in front of the picture.
  double wall_N_per_m = 150.0;
  /// Whether the speed gate, the speed cap and the energy tank are used. Without them eq. 8 is rendered as
  /// printed, which pushes a resting hand and generates energy without limit.
  bool is_bounded = true;
  /// Speed at which the gate passes half of the force, > 0. Slower hands count as resting: the sensor's last
  /// digit must not move a hand. 1 … 50 mm/s.
  double knee_m_per_s = 0.005;
  /// Time constant over which the speed for gate and cap is smoothed, >= 0. 0 … 0.2 s.
  double speed_window_s = 0.04;
  /// Cosine of the angle between the pushes of two ticks below which the hand has reversed, -1 … 0. At a
  /// square corner the tangent turns by a right angle, which is not a reversal.
  double reversal_cosine = -0.5;
};

/// `tracing` (graphic-haptic display 2006, eq. 8, corrected): f = F_m (d·t) |b| t. It pushes a hand that
/// moves along a boundary onwards in its direction; there is no force across the boundary and none at rest. d
/// is the direction of Hayward & Armstrong (eqs 5–6), which keeps its last value when the hand stops, so the
/// force is gated by the speed: s(v) = r / (r + 1), r = (v / knee)^6.
/// The force is active. The energy that it may deliver is limited by an energy tank (50 mJ, never below zero,
/// refilled at 100 mW), and the force is zero at 0.25 m/s and above. A push along every motion is negative
/// friction: it would keep a hand oscillating about a fixed aim. So a reversal of the hand empties the tank,
/// and refilling waits until there has been no reversal for a second.
/// Without its limits (TracingParameters::is_bounded) it is eq. 8 alone. It acts in the picture's plane; a
/// weak one-sided wall keeps the hand in front of z = 0. Tick path.
class TracingLaw {
 public:
  /// The largest displacement in one tick that the tank covers, as a speed: that of TickOptions, above which
  /// the servo loop rejects a reading.
  static constexpr double kFastest_m_per_s = 2.5;
  static constexpr double kSpeedCap_m_per_s = 0.25;
  static constexpr double kTank_J = 0.05;
  static constexpr double kRefill_W = 0.1;
  static constexpr double kSteady_s = 1.0;

  /// All zero = a new touch at rest with a full tank.
  struct State {
    /// w of eq. 5, and the hand's position and force in the previous tick.
    double w_x_m, w_y_m;
    double last_x_m, last_y_m;
    double last_fx_N, last_fy_N;
    /// Velocity, smoothed over speed_window_s so that the sensor's last digit does not count as motion.
    double vx_m_per_s, vy_m_per_s;
    /// Energy delivered and not yet refilled; 0 = full tank, at most kTank_J.
    double spent_J;
    /// Direction of the last push (or of the one that the tank withheld), and the time since the last
    /// reversal against it.
    double heading_x, heading_y;
    double steady_s;
    bool begun;
  };

  TracingLaw(std::shared_ptr<const models::BoundaryMap> map, const TracingParameters& parameters)
      : map_(std::move(map)), p_(parameters) {}

  LawOutput evaluate(const Hand& hand, State& state) const noexcept;

  EnergyModel energy_model() const noexcept {
    return p_.is_bounded ? EnergyModel::self_limited : EnergyModel::none;
  }
  const models::BoundaryMap& surface() const noexcept { return *map_; }
  double damping_Ns_per_m() const noexcept { return p_.damping_Ns_per_m; }
  std::size_t memory_bytes() const noexcept { return map_->memory_bytes(); }

 private:
  std::shared_ptr<const models::BoundaryMap> map_;
  TracingParameters p_;
};

}  // namespace palpable::haptics
