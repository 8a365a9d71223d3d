// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace palpable::haptics {

/// Observes whether the loop generates energy (after Hannaford & Ryu 2002, in the form that is exact for a
/// force that is held between samples). Between two readings the device holds one force. So the hand receives
/// f(n-1)·(x(n) - x(n-1)), however it moves in between. Two balances are kept, in J, in the device frame.
///
/// 1. For laws with a potential. The energy that the law's springs store was put in by the hand and may be
/// returned. So the balance
///     W(n) = sum f·dx + stored(n) - stored(at the start of the touch)
/// cannot rise if the system is passive. A held spring force lags, which generates ½K·dx² per tick; the
/// virtual damper must dissipate more than that: b·v²·T. The energy R that it dissipated in the last
/// kReserve_s is its reserve. W is bounded below by -R, so that energy that friction dissipated long ago does
/// not offset energy that is generated now. If W > 0 in a tick in which the hand receives energy (f·dx > 0),
/// W is the energy generated beyond the reserve. While the hand delivers energy, a positive W is only stored
/// in a spring (the first tick inside a wall stores ½K·dx² that the hand did not deliver), and the damper may
/// still dissipate it. During a ramp or a change of scene the springs store more than the hand delivered:
/// then W may fall but not rise.
///
/// W also counts what a spring stores without having received it, although the hand may never get it: the
/// first tick inside a wall, a spring that is lost while its forces are still on their way. So the energy
/// that is reported as generated is the lesser of W and of what the hand really received since any earlier
/// tick, beyond what the springs stored in the ticks from which the forces then on their way came.
///
/// The work of a guide's force is not counted in any balance: its reserve bounds it.
///
/// 2. For all laws. The work sum f·dx of a contact that began in free air. On a passive surface it never
/// rises above 0. It is the only balance of laws without a potential. For those, each tick without force
/// starts a new balance, which can be repeated from a recording.
///
/// Tick path; no allocation.
class PassivityObserver {
 public:
  /// Time constant over which the virtual damper's dissipation counts as reserve.
  static constexpr double kReserve_s = 0.1;

  static constexpr std::size_t kMostDelay = 15;

  struct Step {
    /// The force that the motors held since the previous tick, N, and the movement during that time, m.
    Vector<DeviceFrame> held_force_N;
    Vector<DeviceFrame> moved_m;
    /// How far the touched surface itself moved meanwhile, m: a damper dissipates by the difference.
    Vector<DeviceFrame> surface_moved_m;
    /// Work of the held torque on the hand since then, J; 0 for devices without torque.
    double rotation_J = 0.0;
    double dt_s = 0.001;
    /// Stored energy at the new position in the device frame (LawOutput::stored_J / scene_from_device.scale),
    /// without the part that a rise limit withholds. NaN: the law has no potential.
    double stored_J = 0.0;
    /// What a change of the law's parameters on the same surface added to stored_J since the previous step:
    /// the law did not generate it.
    double changed_J = 0.0;
    /// The part of the held force whose energy a guide's limited reserve supplied (LawOutput::guide_N).
    Vector<DeviceFrame> guide_N;
    /// Ticks until a force acts, 0 ... kMostDelay.
    std::size_t delay = 0;
    /// What the law stores is the energy of contact springs, 0 out of contact, and not a potential defined
    /// everywhere. That holds also where stored_J is not known.
    bool is_spring = true;
    /// The damping that the law guarantees in contact, N·s/m; 0 out of contact.
    double damping_Ns_per_m = 0.0;
    bool contact = false;
    /// The held force was reduced by a ramp or a change of scene, or by the force cap for a law without a
    /// spring.
    bool shortened = false;
    /// The held force is zero because the controller reduced it, not because the hand was in free air.
    bool weakened = false;
    /// The held force was changed by a change of scene, not by the law.
    bool scene_changes = false;
  };

  /// How a new balance begins. `from_no_force`: the ramp is at zero, which is equivalent to free air.
  enum class Beginning { from_no_force, in_contact };

  /// A new scene or a new touch: the energy that is stored now is the new reference.
  void begin(double stored_J, Beginning beginning) noexcept {
    balance_J_ = std::min(balance_J_, 0.0);
    made_J_ = 0.0;
    stored_J_ = std::isfinite(stored_J) ? stored_J : 0.0;
    held_J_.fill(0.0);
    held_J_[newest_] = least_J_ = stored_J_;
    received_J_ = 0.0;
    work_J_ = 0.0;
    began_in_air_ = beginning == Beginning::from_no_force;
  }

  /// The balance W after this step, J.
  double update(const Step& step) noexcept {
    const double received_J = dot(step.held_force_N, step.moved_m) + step.rotation_J;
    count_work(step, received_J);
    if (std::isfinite(step.stored_J)) {
      count_balance(step, received_J);
    } else {
      balance_J_ = work_J_;
      received_J_ = least_J_ = 0.0;
    }
    made_J_ = received_J > 0.0 ? std::max({balance_J_, work_J_, 0.0}) : 0.0;
    made_max_J_ =
        std::max(made_max_J_, std::isfinite(step.stored_J) && step.is_spring ? returned_J() : made_J_);
    end_work(step);
    return balance_J_;
  }

  double balance_J() const noexcept { return balance_J_; }
  /// Energy generated beyond the reserve, in the last step, if the hand received energy in it, J; >= 0: the
  /// controller's bound, W.
  double made_J() const noexcept { return made_J_; }
  /// The greatest energy since construction that is reported as generated, J: made_J(), but no more than the
  /// hand received.
  double made_max_J() const noexcept { return made_max_J_; }

 private:
  void count_work(const Step& step, double received_J) noexcept {
    if (step.scene_changes && std::isfinite(step.stored_J)) began_in_air_ = false;
    if (began_in_air_)
      work_J_ += received_J - dot(step.guide_N, step.moved_m) - std::max(0.0, step.changed_J);
    if (!began_in_air_) work_J_ = 0.0;
  }

  void end_work(const Step& step) noexcept {
    // A spring may return energy after a tick without force, in which a damper cancelled it. A law that
    // stores no energy may not.
    const bool ends = !step.contact || !(step.is_spring || std::isfinite(step.stored_J));
    if (ends && !step.weakened && step.held_force_N == Vector<DeviceFrame>{}) {
      began_in_air_ = true;
      work_J_ = 0.0;
    }
  }

  /// What of made_J_ the hand has received.
  double returned_J() const noexcept {
    return made_J_ > 0.0 ? std::max({std::min(made_J_, received_J_ - least_J_), work_J_, 0.0}) : 0.0;
  }

  void count_balance(const Step& step, double received_J) noexcept {
    const double along = norm(step.held_force_N);
    const double past_J = received_J - step.rotation_J - dot(step.held_force_N, step.surface_moved_m);
    const double speed = along > 0.0 && step.dt_s > 0.0 ? past_J / (along * step.dt_s) : 0.0;
    reserve_J_ += step.damping_Ns_per_m * speed * speed * step.dt_s -
                  reserve_J_ * std::min(1.0, step.dt_s / kReserve_s);
    const double made_J =
        received_J - dot(step.guide_N, step.moved_m) + step.stored_J - stored_J_ - step.changed_J;
    balance_J_ = std::max(balance_J_ + (step.shortened ? std::min(made_J, 0.0) : made_J), -reserve_J_);
    stored_J_ = step.stored_J;
    count_received(step, received_J - dot(step.guide_N, step.moved_m) - step.changed_J);
  }

  void count_received(const Step& step, double received_J) noexcept {
    received_J_ += received_J;
    newest_ = (newest_ + 1) % held_J_.size();
    held_J_[newest_] = step.stored_J;
    double most_J = step.stored_J;
    for (std::size_t age = 1; age <= std::min(step.delay, kMostDelay); ++age)
      most_J = std::max(most_J, held_J_[(newest_ + held_J_.size() - age) % held_J_.size()]);
    least_J_ = std::min(least_J_, received_J_ + most_J);
  }

  double balance_J_ = 0.0;
  double reserve_J_ = 0.0;
  double stored_J_ = 0.0;
  /// What the hand received since the balance began; the least of it and of what the springs stored then; and
  /// what they stored in the last ticks.
  double received_J_ = 0.0;
  double least_J_ = 0.0;
  std::array<double, kMostDelay + 1> held_J_{};
  std::size_t newest_ = 0;
  double work_J_ = 0.0;
  bool began_in_air_ = false;
  double made_J_ = 0.0;
  double made_max_J_ = 0.0;
};

/// The passivity controller's factor for force and torque, 0 ... 1. `gives_W` is the power that they deliver
/// to the hand. The factor reduces the energy delivered in one tick by `made_J`, at most to zero. It is 1
/// where nothing was generated or the hand delivers energy. Tick path.
inline double passivity_factor(double gives_W, double made_J, double dt_s) noexcept {
  // At rest the balance contains only rounding errors: less than a nanojoule cannot be felt.
  constexpr double kNegligible_J = 1e-9;
  if (made_J <= kNegligible_J || gives_W <= 0.0) return 1.0;
  return std::max(0.0, 1.0 - made_J / (dt_s * gives_W));
}

/// The same for a force alone. The result is never a pull and has no new lateral component. Tick path.
inline Vector<DeviceFrame> control_passivity(Vector<DeviceFrame> force_N,
                                             Vector<DeviceFrame> velocity_m_per_s, double made_J,
                                             double dt_s) noexcept {
  const double factor = passivity_factor(dot(force_N, velocity_m_per_s), made_J, dt_s);
  return factor < 1.0 ? factor * force_N : force_N;
}

}  // namespace palpable::haptics
