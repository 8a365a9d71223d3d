// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/safety/limits.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Limits how fast a force grows (cap_rise) and ramps it up and down, without generating energy. If the force
/// of a spring that stores U was held back (by the limit, a ramp, a dropped force), the hand has put only the
/// input energy P into it: what it put in during this contact, also before a dropped force and into dampers
/// and friction since, less what it got back. A hand at rest meets the whole spring nevertheless. A hand that
/// moves out meets, after a twentieth of the depth, a spring that begins deeper, with the potential V =
/// (sqrt(U) - c)^2 = P and the share dV/dU = 1 - c / sqrt(U) of the law's force; docs/real-time.md ("Rise
/// limit") derives it. From then on V follows P. Damping and friction, which are not the spring's, stay
/// whole. Where the ramp of a touch that begins in contact loads the spring, the hand gets back what the ramp
/// brought (Input::loads). A tick is account(), then take_back(), then limit(). Tick path; no allocation.
class RiseLimit {
 public:
  struct Input {
    /// What the law's spring stores now, and its force, after the cap; NaN where the law has no spring: then
    /// the force follows the ramp, and nothing is counted.
    double stored_J = 0.0;
    Vector<DeviceFrame> spring_N;
    /// What a change of scene added to stored_J since the last call. `moves`: because the surface moves,
    /// which loads a spring that is held back, too, by its share; and what its dampers and friction brought
    /// then.
    double changed_J = 0.0;
    double damped_J = 0.0;
    bool moves = false;
    /// What the hand received since the last call, of force and torque, J, and how far that may be wrong by
    /// the sensor's step; what the forces that are on their way will give it; and how far it moved in the
    /// sense of the spring's force, m.
    double received_J = 0.0;
    double unsure_J = 0.0;
    double coming_J = 0.0;
    double moved_out_m = 0.0;
    /// The ramp, 0 ... 1, and by how much it may rise in this tick.
    double gain = 1.0;
    double gain_rise = 1.0;
    /// The ramp rises under a hand that was in contact when its touch, or its force after a pause, began: it
    /// loads the spring as a surface does that comes up under the hand.
    bool loads = false;
  };

  /// The movement since the last call.
  void account(const Input& in) noexcept {
    const double input_before_J = input_energy_J();
    falls_ = in.gain < gain_;
    gain_ = in.gain;
    has_spring_ = in.stored_J > 0.0 && norm(in.spring_N) > 0.0;
    loads_ = in.loads && has_spring_;
    brought_J_ = added_J_ = 0.0;
    spring_N_ = in.spring_N;
    stored_J_ = has_spring_ ? in.stored_J : 0.0;
    root_ = std::sqrt(stored_J_);
    if (!has_spring_) {
      begins_ = false;
      release_left_ = spring_offset_ = rendered_J_ = surplus_J_ = input_energy_J_ = unsure_J_ = 0.0;
      added_J_ = in.changed_J;
      return;
    }
    unsure_J_ = std::max(unsure_J_, in.unsure_J);
    change(in);
    const double moved_J = in.damped_J + (in.moves ? added_J_ : 0.0);
    input_energy_J_ = std::clamp(input_before_J - in.received_J + moved_J, 0.0, stored_J_);
    if (loads_) {
      load();
      return;
    }
    // While the force went to zero the hand may have received energy, but it put in none.
    if (begins_) begin_release(std::min(input_before_J, input_energy_J_));
    begins_ = false;
    if (release_left_ > 0.0) {
      release(in);
      return;
    }
    set_offset(spring_offset_);
    follow(in);
  }

  /// No account() follows in this tick: nothing was brought or added.
  void hold() noexcept { brought_J_ = added_J_ = 0.0; }

  /// The force of this tick, of the one that the law wants after the cap; `rest_N` of it is not the spring's.
  /// `velocity_m_per_s`: of the hand; `most_lost`: see cap_rise().
  Limited<DeviceFrame> limit(Vector<DeviceFrame> law_N, Vector<DeviceFrame> rest_N, double max_rise_N,
                             Vector<DeviceFrame> velocity_m_per_s, double most_lost = 1.0) noexcept {
    const auto wanted = not_growing(rendered(law_N, rest_N), force_N_);
    Limited<DeviceFrame> risen = cap_rise(wanted.force_N, force_N_, max_rise_N, velocity_m_per_s, most_lost);
    risen.limited = risen.limited || wanted.limited;
    if (risen.limited) note_limited();
    force_N_ = risen.force_N;
    return risen;
  }

  /// The passivity controller reduced the force that limit() returned.
  void weakened_to(Vector<DeviceFrame> force_N) noexcept { force_N_ = force_N; }

  /// The account of energy shows that so much was made, J: a spring that is held back does not return it.
  void take_back(double made_J) noexcept {
    if (!is_weaker() || !(made_J > 0.0)) return;
    if (release_left_ > 0.0) {
      input_energy_J_ = std::max(0.0, input_energy_J_ - made_J);
    } else {
      surplus_J_ = std::max(-rendered_J_, surplus_J_ - made_J);
    }
  }

  /// The spring was held back: its force by limit(), or another part of it, a torque, after it.
  void note_limited() noexcept {
    if (!has_spring_) return;
    const double returned_J = gain_ < 1.0 ? input_energy_J() : std::min(input_energy_J(), rendered_J_);
    begin_release(release_left_ > 0.0 ? input_energy_J_ : std::min(input_energy_J_, returned_J));
  }

  /// The motors hold no force any more, in the same touch.
  void drop() noexcept {
    begin_release(input_energy_J());
    force_N_ = {};
    begins_ = true;
  }
  /// A new touch begins, of which nothing is known.
  void reset() noexcept { *this = {}; }

  /// The share of the spring's force that is rendered now; without a spring the ramp.
  double share() const noexcept {
    if (!has_spring_) return gain_;
    return spring_offset_ > 0.0 ? 1.0 - spring_offset_ / root_ : 1.0;
  }
  /// While the ramp falls, a force or torque does not grow, though the limit may have held it below the
  /// law's.
  Limited<DeviceFrame> not_growing(Vector<DeviceFrame> wanted, Vector<DeviceFrame> before) const noexcept {
    return falls_ ? cap_force(wanted, norm(before)) : Limited<DeviceFrame>{wanted, false};
  }
  /// Whether the rendered spring returns less energy than the law's spring stores.
  bool is_weaker() const noexcept { return has_spring_ && (release_left_ > 0.0 || spring_offset_ > 0.0); }
  /// What a ramp that loads the spring (Input::loads) brought since the account() before, beyond what the
  /// hand put in; and what a change of scene added to the rendered spring. J.
  double brought_J() const noexcept { return brought_J_; }
  double added_J() const noexcept { return added_J_; }
  double withheld_J() const noexcept { return std::max(0.0, stored_J_ - input_energy_J()); }
  /// The energy that the hand put in and may get back, P.
  double input_energy_J() const noexcept {
    return release_left_ > 0.0 ? input_energy_J_ : rendered_J_ + surplus_J_;
  }

 private:
  /// The share of the depth over which a spring that was held back changes from the whole one to the one that
  /// returns P.
  static constexpr double kReleaseDepth = 0.05;

  /// The spring was held back while the hand had put in this much.
  void begin_release(double input_energy_J) noexcept {
    input_energy_J_ = input_energy_J;
    release_left_ = 1.0;
  }

  /// What a change of scene adds at the hand's place. A surface that moves takes a spring that is held back
  /// with it; another scene's, which comes up under the hand, begins where the hand is.
  void change(const Input& in) noexcept {
    added_J_ = in.changed_J;
    if (spring_offset_ <= 0.0 || in.changed_J == 0.0) return;
    const double before = std::sqrt(std::max(0.0, stored_J_ - in.changed_J));
    const double kept = std::max(0.0, before - spring_offset_);
    if (in.moves && (loads_ || release_left_ > 0.0)) {
      added_J_ = before > 0.0 ? kept / before * in.changed_J : 0.0;
      return;
    }
    if (!in.moves) spring_offset_ = std::max(0.0, spring_offset_ + root_ - before);
    const double now = std::max(0.0, root_ - spring_offset_);
    added_J_ = release_left_ > 0.0 ? 0.0 : now * now - kept * kept;
  }

  /// The law's spring with the ramp's share of its stiffness, which stores that share of U. What the hand has
  /// not put in of that is brought: the ramp's part, and what a held force gave too much meanwhile.
  void load() noexcept {
    begins_ = false;
    release_left_ = 0.0;
    set_offset(root_ * (1.0 - gain_));
    rendered_J_ = gain_ * stored_J_;
    brought_J_ = std::max(0.0, rendered_J_ - input_energy_J_);
    input_energy_J_ += brought_J_;
    surplus_J_ = input_energy_J_ - rendered_J_;
  }

  void release(const Input& in) noexcept {
    const double goal = root_ * (1.0 - gain_);
    // A spring that stores U at a force f is 2 U / f deep.
    if (release_left_ >= 1.0) release_over_m_ = kReleaseDepth * 2.0 * stored_J_ / norm(spring_N_);
    // A hand that moves in again meets the same share at the same depth.
    release_left_ = std::clamp(release_left_ - in.moved_out_m / release_over_m_, 0.0, 1.0);
    // Stronger forces than the next ones are still on their way to the motors, and the next tick may give
    // more than this one: the hand becomes faster.
    constexpr double kGrowth = 2.0;
    if (in.moved_out_m > 0.0 && input_energy_J_ <= in.coming_J + kGrowth * std::max(0.0, in.received_J))
      release_left_ = 0.0;
    if (gain_ >= 1.0 && input_energy_J_ >= stored_J_) release_left_ = 0.0;
    if (release_left_ > 0.0) {
      const double last_offset = std::max(goal, root_ - std::sqrt(input_energy_J_));
      set_offset(goal + (1.0 - release_left_) * (last_offset - goal));
      return;
    }
    set_offset(std::max(goal, root_ - std::sqrt(std::max(0.0, input_energy_J_ - in.coming_J))));
    surplus_J_ = input_energy_J_ - rendered_J_;
  }

  void set_offset(double offset) noexcept {
    spring_offset_ = std::min(offset, root_);
    const double over = root_ - spring_offset_;
    rendered_J_ = spring_offset_ > 0.0 ? over * over : stored_J_;
  }

  /// The spring follows the ramp and P. What the hand puts into dampers and friction comes back into it, at
  /// the ramp's rate; where a held force gave more than V lost, a hand that moves out does not get that
  /// twice.
  void follow(const Input& in) noexcept {
    const double goal = root_ * (1.0 - gain_);
    // A plain sum of forces times movements begins anew where the force is zero: nothing is owed beyond that.
    const bool owes = spring_offset_ > 0.0 && rendered_J_ > 0.0 && force_N_ != Vector<DeviceFrame>{};
    if (gain_ >= 1.0 && !owes) input_energy_J_ = rendered_J_;
    const double sure_J = std::max(0.0, input_energy_J_ - unsure_J_);
    if (spring_offset_ < goal) {
      set_offset(goal);
    } else if (rendered_J_ > input_energy_J_ && in.moved_out_m > 0.0) {
      set_offset(root_ - std::sqrt(input_energy_J_));
    } else if (rendered_J_ < sure_J && spring_offset_ > 0.0) {
      set_offset(std::max({goal, spring_offset_ - in.gain_rise * root_, root_ - std::sqrt(sure_J)}));
    }
    surplus_J_ = input_energy_J_ - rendered_J_;
  }

  Vector<DeviceFrame> rendered(Vector<DeviceFrame> law_N, Vector<DeviceFrame> rest_N) const noexcept {
    const double part = share();
    if (!has_spring_ || gain_ <= 0.0) return gain_ * law_N;
    if (part >= 1.0) return law_N;
    const Vector<DeviceFrame> force_N = part * spring_N_ + rest_N;
    // No damper pulls.
    if (dot(force_N, spring_N_) <= 0.0) return {};
    return cap_force(force_N, norm(law_N)).force_N;
  }

  Vector<DeviceFrame> force_N_;
  Vector<DeviceFrame> spring_N_;
  double gain_ = 0.0;
  bool falls_ = false;
  bool has_spring_ = false;
  bool begins_ = true;
  bool loads_ = false;
  double brought_J_ = 0.0;
  double added_J_ = 0.0;
  /// U, the energy that the law's spring stores.
  double stored_J_ = 0.0;
  /// sqrt(U).
  double root_ = 0.0;
  /// c, by which the rendered spring begins deeper, in the unit of sqrt(U); 0: the whole spring.
  double spring_offset_ = 0.0;
  /// V, the energy that the rendered spring stores.
  double rendered_J_ = 0.0;
  /// The input energy beyond V: P = V + this, if no release is going on. Below 0 where a held force gave more
  /// than V lost.
  double surplus_J_ = 0.0;
  /// How far P may be wrong, in this contact.
  double unsure_J_ = 0.0;
  /// P during a release.
  double input_energy_J_ = 0.0;
  /// The part of a release that is still to come: 1 for a hand that has not moved out, 0 at its end.
  double release_left_ = 0.0;
  /// The way out over which it ends, m; from where it began.
  double release_over_m_ = 0.0;
};

}  // namespace palpable::haptics
