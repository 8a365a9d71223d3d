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
  /// F_m of eq. 8: the force on a boundary of full strength, moving along it. 0 … 5 N.
  double force_N = 1.0;
  /// epsilon of eqs 5–6, the distance over which the hand's direction is estimated: a few times the device's
  /// resolution, 10 um … 5 mm.
  double direction_m = 0.0005;
  /// Viscous damping of all motion, N·s/m.
  double damping_Ns_per_m = 0.2;
  /// Of the light wall at z = 0 that keeps a hand with three axes on the picture.
  double wall_N_per_m = 150.0;
  /// The speed gate, the speed cap and the tank of energy; without them eq. 8 is rendered as it is printed,
  /// which pushes a resting hand and makes energy without bound.
  bool is_bounded = true;
};

/// `tracing` (graphic-haptic display 2006, eq. 8, corrected): f = F_m (d·t) |b| t, pushing a hand that moves
/// along a boundary onwards, whichever way it goes; nothing across it, nothing at rest. d is Hayward &
/// Armstrong's direction (eqs 5–6), which keeps its last value when the hand stops, so the force is gated by
/// speed: s(v) = r / (r + 1), r = (v / 5 mm/s)^6. The field is active: what it may give is bounded by a tank
/// of energy (50 mJ, never below zero, refilled at 100 mW), and it gives nothing at 0.25 m/s and above. A
/// push along every motion is a friction of the wrong sign: it would keep a hand swinging that only holds its
/// aim. So a hand that turns round empties the tank, and the refill waits until it has not turned round for
/// a second. Without its bounds (TracingParameters::is_bounded) it is eq. 8 alone. Acts in the picture's
/// plane; a one-sided light wall holds the hand in front of z = 0. Tick path.
class TracingLaw {
 public:
  /// The largest displacement in one tick that the tank is prepared for, as a speed: the servo loop refuses
  /// faster readings.
  static constexpr double kFastest_m_per_s = 2.0;
  static constexpr double kSpeedCap_m_per_s = 0.25;
  static constexpr double kTank_J = 0.05;
  static constexpr double kRefill_W = 0.1;
  static constexpr double kSteady_s = 1.0;

  /// All zero = a new touch at rest with a full tank.
  struct State {
    /// w of eq. 5, and the hand and force of the last tick.
    double w_x_m, w_y_m;
    double last_x_m, last_y_m;
    double last_fx_N, last_fy_N;
    /// Speed, smoothed over 40 ms so that a sensor's last digit is no motion.
    double vx_m_per_s, vy_m_per_s;
    /// What was given and not yet refilled; 0 = full, never above kTank_J.
    double spent_J;
    /// Where the push last pointed or would have, and for how long it has not turned against that.
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
