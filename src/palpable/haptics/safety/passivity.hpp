// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Watches whether the loop makes energy (after Hannaford & Ryu 2002, in the form that is exact for a held
/// force). Between two readings the device holds one force, so the hand receives f(n-1)·(x(n) - x(n-1)),
/// whatever it does in between. Two accounts are kept; units: J, of the device's own frame.
///
/// With a potential: what the law's springs store is the hand's own work and may come back; so the balance
///     W(n) = sum f·dx + stored(n) - stored(at the touch's begin)
/// cannot rise in a passive world: a held spring lags, which makes ½K·dx² a tick, and the virtual damper has
/// to take out more than that, b·v²·T. What it took out in the last kReserve_s, R, is the reserve of the
/// virtual damper: W is not allowed to fall below -R, because energy that friction took out long ago pays for
/// nothing that is made now. W > 0 in a tick in which the hand receives energy (f·dx > 0) is energy made
/// beyond the reserve; while the hand still gives, a positive W is only stored in a spring (the first tick
/// inside a wall stores ½K·dx² unpaid) and the damper may yet take it. Under a ramp or a change of scene the
/// springs store more than the hand gave: W may then fall but not rise.
///
/// Always: the plain work sum f·dx of a contact that began in free air. No passive surface lets it rise above
/// 0, whatever its law. It is all that is known of laws without a potential: there each tick without force
/// begins a new account, as whoever reads a recording counts.
/// Tick path; no allocation.
class PassivityObserver {
 public:
  /// How long the virtual damper's work counts.
  static constexpr double kReserve_s = 0.1;

  struct Step {
    /// The force that the motors held since the tick before, N, and the movement under it, m.
    Vector<DeviceFrame> held_force_N;
    Vector<DeviceFrame> moved_m;
    /// What the held torque gave the hand over the turn since, J; 0 of devices without torque.
    double turned_J = 0.0;
    double dt_s = 0.001;
    /// In the device's frame (LawOutput::stored_J / scene_from_device.scale), at the new position, without
    /// what a rise limit withholds; NaN: the law has no potential.
    double stored_J = 0.0;
    /// The law's promise while in contact, N·s/m; 0 out of contact.
    double damping_Ns_per_m = 0.0;
    bool contact = false;
    /// The held force was shortened by a ramp or a change of scene, or by the cap of a law without a spring.
    bool shortened = false;
    /// It is zero because the controller weakened it, not because the hand was in free air.
    bool weakened = false;
    /// By a change of scene: on purpose, and not the law's doing.
    bool scene_changes = false;
  };

  /// How a new account begins. From no force: the ramp is at zero, as in free air.
  enum class Beginning { from_no_force, in_contact };

  /// Another scene, or a new touch: what is stored now is where counting goes on from.
  void begin(double stored_J, Beginning beginning) noexcept {
    balance_J_ = std::min(balance_J_, 0.0);
    made_J_ = 0.0;
    stored_J_ = std::isfinite(stored_J) ? stored_J : 0.0;
    work_J_ = 0.0;
    began_in_air_ = beginning == Beginning::from_no_force;
  }

  /// The balance after this step.
  double update(const Step& step) noexcept {
    const double received_J = dot(step.held_force_N, step.moved_m) + step.turned_J;
    count_work(step, received_J);
    if (std::isfinite(step.stored_J)) {
      count_balance(step, received_J);
    } else {
      balance_J_ = work_J_;
    }
    made_J_ = received_J > 0.0 ? std::max({balance_J_, work_J_, 0.0}) : 0.0;
    made_max_J_ = std::max(made_max_J_, made_J_);
    return balance_J_;
  }

  double balance_J() const noexcept { return balance_J_; }
  /// Energy made beyond the reserve and received in the last step; 0 or more.
  double made_J() const noexcept { return made_J_; }
  /// The greatest of it since construction.
  double made_max_J() const noexcept { return made_max_J_; }

 private:
  void count_work(const Step& step, double received_J) noexcept {
    if (step.scene_changes && std::isfinite(step.stored_J)) began_in_air_ = false;
    if (began_in_air_) work_J_ += received_J;
    if (!began_in_air_) work_J_ = 0.0;
    // What was given to a spring may come back after a tick without force; where no energy is stored, nothing
    // may.
    const bool ends = !step.contact || !std::isfinite(step.stored_J);
    if (ends && !step.weakened && step.held_force_N == Vector<DeviceFrame>{}) {
      began_in_air_ = true;
      work_J_ = 0.0;
    }
  }

  void count_balance(const Step& step, double received_J) noexcept {
    const double along = norm(step.held_force_N);
    const double speed =
        along > 0.0 && step.dt_s > 0.0 ? (received_J - step.turned_J) / (along * step.dt_s) : 0.0;
    reserve_J_ += step.damping_Ns_per_m * speed * speed * step.dt_s -
                  reserve_J_ * std::min(1.0, step.dt_s / kReserve_s);
    const double made_J = received_J + step.stored_J - stored_J_;
    balance_J_ = std::max(balance_J_ + (step.shortened ? std::min(made_J, 0.0) : made_J), -reserve_J_);
    stored_J_ = step.stored_J;
  }

  double balance_J_ = 0.0;
  double reserve_J_ = 0.0;
  double stored_J_ = 0.0;
  double work_J_ = 0.0;
  bool began_in_air_ = false;
  double made_J_ = 0.0;
  double made_max_J_ = 0.0;
};

/// Takes the energy made, `made_J`, out again: a force (and torque) that gives the hand `gives_W` is weakened
/// by as much as gives `made_J` less in a tick, down to nothing. The factor for both, 0 ... 1; 1 where
/// nothing was made or the hand is giving. Tick path.
inline double passivity_factor(double gives_W, double made_J, double dt_s) noexcept {
  // At rest everything is rounding: no hand notices less than a nanojoule.
  constexpr double kNegligible_J = 1e-9;
  if (made_J <= kNegligible_J || gives_W <= 0.0) return 1.0;
  return std::max(0.0, 1.0 - made_J / (dt_s * gives_W));
}

/// The same for a force alone: never a pull, never a push to a side. Tick path.
inline Vector<DeviceFrame> control_passivity(Vector<DeviceFrame> force_N,
                                             Vector<DeviceFrame> velocity_m_per_s, double made_J,
                                             double dt_s) noexcept {
  const double factor = passivity_factor(dot(force_N, velocity_m_per_s), made_J, dt_s);
  return factor < 1.0 ? factor * force_N : force_N;
}

}  // namespace palpable::haptics
