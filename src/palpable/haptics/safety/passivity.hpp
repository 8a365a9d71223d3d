// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Watches whether the loop makes energy (after Hannaford & Ryu 2002, in the form that is exact for a held
/// force). Between two readings the device holds one force, so the hand receives f(n-1)·(x(n) - x(n-1)),
/// whatever it does in between. What the law's springs store is the hand's own work and may come back; so the
/// balance
///     W(n) = sum f·dx + stored(n) - stored(at the touch's begin)
/// cannot rise in a passive world: a held spring lags, which makes ½K·dx² a tick, and the virtual damper has
/// to take out more than that, b·v²·T. What it took out in the last kReserve_s, R, is the reserve of the
/// virtual damper: W is not allowed to fall below -R, because energy that friction took out long ago pays for
/// nothing that is made now. W > 0 in a tick in which the hand receives energy (f·dx > 0) is energy made
/// beyond the reserve; while the hand still gives, a positive W only stands in a spring (the first tick
/// inside a wall stores ½K·dx² unpaid) and the damper may yet take it. Units: J, of the device's own frame.
/// Under the force cap, a ramp or a change of scene the springs store more than the hand gave and will get
/// back: W may then fall but not rise. (The rate cap is no such excuse: what it holds back comes later, and
/// is energy made.) Tick path; no allocation.
class PassivityObserver {
 public:
  /// How long the virtual damper's work counts.
  static constexpr double kReserve_s = 0.1;

  struct Step {
    /// The force that the motors held since the tick before, N, and the movement under it, m.
    Vector<DeviceFrame> held_force_N;
    Vector<DeviceFrame> moved_m;
    double dt_s = 0.001;
    /// In the device's frame (LawOutput::stored_J / scene_from_device.scale), at the new position.
    double stored_J = 0.0;
    /// The law's promise while in contact, N·s/m; 0 out of contact.
    double damping_Ns_per_m = 0.0;
    /// The force cap, a ramp or a change of scene has shortened the law's force.
    bool shortened = false;
  };

  /// Another scene, or a new touch: what is stored now is where counting goes on from.
  void begin(double stored_J) noexcept {
    balance_J_ = std::min(balance_J_, 0.0);
    made_J_ = 0.0;
    stored_J_ = std::isfinite(stored_J) ? stored_J : 0.0;
  }

  /// The balance W after this step.
  double update(const Step& step) noexcept {
    const double along = norm(step.held_force_N);
    const double speed =
        along > 0.0 && step.dt_s > 0.0 ? dot(step.held_force_N, step.moved_m) / (along * step.dt_s) : 0.0;
    reserve_J_ += step.damping_Ns_per_m * speed * speed * step.dt_s -
                  reserve_J_ * std::min(1.0, step.dt_s / kReserve_s);
    const double received_J = dot(step.held_force_N, step.moved_m);
    const double made_J = received_J + step.stored_J - stored_J_;
    balance_J_ = std::max(balance_J_ + (step.shortened ? std::min(made_J, 0.0) : made_J), -reserve_J_);
    stored_J_ = step.stored_J;
    made_J_ = received_J > 0.0 ? std::max(balance_J_, 0.0) : 0.0;
    made_max_J_ = std::max(made_max_J_, made_J_);
    return balance_J_;
  }

  double balance_J() const noexcept { return balance_J_; }
  /// Energy made beyond the reserve and received in the last tick; 0 or more.
  double made_J() const noexcept { return made_J_; }
  /// The greatest of it since construction.
  double made_max_J() const noexcept { return made_max_J_; }

 private:
  double balance_J_ = 0.0;
  double reserve_J_ = 0.0;
  double stored_J_ = 0.0;
  double made_J_ = 0.0;
  double made_max_J_ = 0.0;
};

/// The most damping that a controller may add to a hand of `mass_kg`, N·s/m, so that it slows and never turns
/// it. A speed that is known D ticks late obeys v(n+1) = v(n) - a·v(n-D) with a = damping·T/m; it dies away
/// without changing sign while a <= D^D / (D+1)^(D+1). D is the device's delay and one tick for the backward
/// difference.
inline double max_passive_damping_Ns_per_m(double mass_kg, double dt_s, int delay_samples) noexcept {
  const double late = static_cast<double>(delay_samples) + 1.0;
  return mass_kg / dt_s * std::pow(late / (late + 1.0), late) / (late + 1.0);
}

/// Takes the energy made, `made_J`, out again as damping: f - alpha·v with alpha = made / (T·|v|²), but never
/// more than `max_damping_Ns_per_m`. Unchanged where nothing was made. Tick path.
inline Vector<DeviceFrame> control_passivity(Vector<DeviceFrame> force_N,
                                             Vector<DeviceFrame> velocity_m_per_s, double made_J, double dt_s,
                                             double max_damping_Ns_per_m) noexcept {
  const double speed2 = dot(velocity_m_per_s, velocity_m_per_s);
  if (made_J <= 0.0 || speed2 <= 0.0) return force_N;
  return force_N - std::min(made_J / (dt_s * speed2), max_damping_Ns_per_m) * velocity_m_per_s;
}

}  // namespace palpable::haptics
