// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Bounds the energy that a contact returns by what the hand gave in it and what the spring stores of that.
/// The first tick inside a surface stores energy that the hand did not give, since there was no force yet. A
/// hand that turns back has given it by then. One that grazes a bump within a tick or two does not turn: the
/// force on the far side pushes it on, and returns what nobody gave. On the next bump the spring may be
/// short again: what the hand gave to the first one is lost. The same happens in the middle of a contact: a
/// fast hand leaves a small spring within a tick, and its held force gives more than the spring stores. So a
/// force that pushes the hand the way it goes is reduced such that, until the next tick, it gives no more
/// than is left. A force against the movement and a hand at rest are not affected; nor, below the stiffness
/// limit, is a hand on a smooth surface, whose damper takes what the held force gives too much. Tick path; no
/// allocation.
class ReturnLimit {
 public:
  /// A force and a torque that are about to be sent, on the hand as it will move when they act.
  struct Sending {
    /// Their power, W, and the force's size, N.
    double power_W = 0.0;
    double force_N = 0.0;
    /// What the forces that were sent before but do not act yet will give, J.
    double on_the_way_J = 0.0;
    /// How much less than known the hand may have given, and how much more it may get, within the sensor's
    /// step, J.
    double unsure_J = 0.0;
    /// How long they act, s; and the mass that they accelerate meanwhile, kg; 0: not known.
    double dt_s = 0.001;
    double mass_kg = 0.0;
  };

  /// The hand is in free air and no force is on its way to it: the next contact begins with this.
  void begin() noexcept { given_J_ = 0.0; }
  /// What the hand received since the last call, J; negative: it gave. And what the spring stores now, J.
  void account(double received_J, double stored_J) noexcept {
    given_J_ = std::min(given_J_ - received_J, stored_J);
  }
  /// The contact may return at least this.
  void raise_to(double given_J) noexcept { given_J_ = std::max(given_J_, given_J); }
  /// What the hand gave in this contact less what it received, as far as the spring has kept it, J.
  double given_J() const noexcept { return given_J_; }

  /// The share of force and torque that may be sent, 0 ... 1.
  double share(const Sending& sending) const noexcept {
    if (sending.power_W <= 0.0) return 1.0;
    const double by_speed_J = sending.power_W * sending.dt_s;
    const double gained_Ns = sending.force_N * sending.dt_s;
    const double by_gain_J = sending.mass_kg > 0.0 ? 0.5 * gained_Ns * gained_Ns / sending.mass_kg : 0.0;
    const double left_J = std::max(0.0, given_J_ - sending.on_the_way_J - sending.unsure_J) + kNegligible_J;
    if (by_speed_J + by_gain_J <= left_J) return 1.0;
    // s by_speed + s^2 by_gain = left, in a form that holds for by_gain = 0.
    return 2.0 * left_J / (by_speed_J + std::sqrt(by_speed_J * by_speed_J + 4.0 * by_gain_J * left_J));
  }

 private:
  /// So much may be returned in a tick in any case: a tenth of what the tests of energy allow a whole
  /// contact.
  static constexpr double kNegligible_J = 1e-7;

  double given_J_ = 0.0;
};

}  // namespace palpable::haptics
