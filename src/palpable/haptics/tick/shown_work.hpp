// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/haptics/safety/passivity.hpp"
#include "palpable/haptics/tick/servo_types.hpp"
#include "palpable/haptics/tick/tick_options.hpp"
#include "palpable/haptics/tick/velocity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace palpable::haptics {

/// The work on the hand as the numbers of a recording show it: the written forces, as late as the motors get
/// them, times the movements between readings, in each contact that begins in free air. Through a time
/// without ticks the last force counts for the whole movement, although the watchdog ends it: more is not
/// known. The tick and whoever checks a recording feed the same class, so that neither reports less than the
/// other. Tick path; no allocation.
class ShownWork {
 public:
  struct Tick {
    /// The device's reading; valid or not.
    Point<DeviceFrame> position;
    bool is_valid = true;
    double dt_s = 0.001;
    Vector<DeviceFrame> written_N;
    /// The part of the force whose energy a guide's limited reserve supplies.
    Vector<DeviceFrame> guide_N;
    /// haptics::flag.
    std::uint32_t flags = 0;
    /// False where the work alone proves nothing: a law that is no contact, or a torque.
    bool is_contact_law = true;
    /// The law's springs keep what the hand gave in a contact, also through a tick without force.
    bool has_spring = false;
  };

  ShownWork(const device::Traits& device, const TickOptions& options)
      : stall_s_(options.stall_s),
        ramp_loads_(options.ramp_loads),
        fine_(std::isfinite(device.position_resolution_m) ? device.position_resolution_m : 0.0),
        delay_(static_cast<std::size_t>(std::clamp(device.delay_samples, 0, static_cast<int>(kSent) - 1))) {}

  /// The ticks in their order.
  void take(const Tick& tick) noexcept {
    const Sent held = sent_[(newest_ + kSent - delay_) % kSent];
    newest_ = (newest_ + 1) % kSent;
    // After a stall or a pause the hand may get back what it gave before, though there was no force between.
    const bool weakened = (tick.flags & (flag::kPassivityActed | flag::kStalled | flag::kRamping)) != 0;
    sent_[newest_] = {tick.written_N, tick.guide_N, weakened};
    const Vector<DeviceFrame> moved_m = moved(tick);
    PassivityObserver::Step step;
    const bool stalled = (tick.flags & flag::kStalled) != 0 && tick.dt_s > stall_s_;
    step.moved_m = stalled ? (stall_s_ / tick.dt_s) * moved_m : moved_m;
    // A change of scene or a new touch starts a new balance, as in the servo's own observer. A new touch
    // starts without force, so a hand cannot receive energy that it did not deliver, unless a ramp loads the
    // spring in which it is; after a pause, too.
    const bool is_ramping = (tick.flags & flag::kRamping) != 0;
    loads_ = ramp_loads_ && is_ramping && (loads_ || (tick.flags & (flag::kNewTouch | flag::kPaused)) != 0);
    const bool is_loaded = loads_ && tick.has_spring && (tick.flags & flag::kContact) != 0;
    const bool is_new = (tick.flags & flag::kNewTouch) != 0;
    step.held_force_N = held.force_N;
    step.guide_N = held.guide_N;
    step.weakened = held.weakened;
    step.dt_s = tick.dt_s;
    step.stored_J = std::numeric_limits<double>::quiet_NaN();
    step.contact = (tick.flags & flag::kContact) != 0;
    step.is_spring = tick.has_spring;
    // The readings may have jumped because the hand did, under the force that was held meanwhile.
    if (is_new) count(held, moved_m, step);
    if (is_new && !tick.is_contact_law)
      jump_max_J_ = std::max(jump_max_J_, dot(held.force_N - held.guide_N, step.moved_m));
    const bool is_fading = (tick.flags & flag::kFading) != 0;
    if (!tick.is_contact_law || is_new || is_fading || is_loaded) {
      using Beginning = PassivityObserver::Beginning;
      observer_.begin(0.0, is_new && !is_loaded ? Beginning::from_no_force : Beginning::in_contact);
      // The plain sum leaves out nothing: also what the hand receives during a change of scene.
      if (tick.is_contact_law && !is_new)
        count_since_zero(held, moved_m, step);
      else
        since_zero_J_ = 0.0;
      return;
    }
    counts_ = true;
    count(held, moved_m, step);
  }

  /// Ticks are missing before the next one.
  void forget_place() noexcept { knows_place_ = false; }

  /// Whether any tick was counted.
  bool counts() const noexcept { return counts_; }
  /// The energy that the hand received in this contact beyond what it delivered, if it receives some now; and
  /// the most of it, J.
  double made_J() const noexcept { return observer_.made_J(); }
  double made_max_J() const noexcept { return std::max(observer_.made_max_J(), jump_max_J_); }
  /// The sum of forces times movements, the most of it since the force was last zero, J. It is an upper
  /// bound, never below made_max_J(): of a stall the part of the movement counts that gives the hand more, a
  /// hand gets back after a stall what it delivered before it, changes of scene count, and a force that is
  /// zero because the controller reduced it, or in contact, ends no sum that is above zero.
  double since_zero_max_J() const noexcept { return since_zero_max_J_; }

 private:
  Vector<DeviceFrame> moved(const Tick& tick) noexcept {
    if (!tick.is_valid || !is_finite(tick.position)) return {};
    const Point<DeviceFrame> before = fine_.place();
    const Point<DeviceFrame> now = fine_.update(tick.position);
    const bool knew = knows_place_;
    knows_place_ = true;
    return knew ? now - before : Vector<DeviceFrame>{};
  }

  static constexpr std::size_t kSent = 16;
  struct Sent {
    Vector<DeviceFrame> force_N;
    Vector<DeviceFrame> guide_N;
    bool weakened = false;
  };
  void count(const Sent& held, Vector<DeviceFrame> moved_m, const PassivityObserver::Step& step) noexcept {
    observer_.update(step);
    count_since_zero(held, moved_m, step);
  }
  /// `held` acted during the whole movement, or, in a stall, during a part of it (`step`).
  void count_since_zero(const Sent& held, Vector<DeviceFrame> moved_m,
                        const PassivityObserver::Step& step) noexcept {
    const Vector<DeviceFrame> force_N = held.force_N - held.guide_N;
    const bool goes_on = (held.weakened || step.contact) && since_zero_J_ > 0.0;
    const bool ends = held.force_N == Vector<DeviceFrame>{} && !goes_on;
    since_zero_J_ = ends ? 0.0 : since_zero_J_ + std::max(dot(force_N, moved_m), dot(force_N, step.moved_m));
    since_zero_max_J_ = std::max(since_zero_max_J_, since_zero_J_);
  }

  double stall_s_;
  bool ramp_loads_;
  std::array<Sent, kSent> sent_{};
  std::size_t newest_ = 0;
  PassivityObserver observer_;
  FinePosition fine_;
  std::size_t delay_;
  bool counts_ = false;
  bool loads_ = false;
  bool knows_place_ = false;
  /// The most that a force which is no contact's gave over a jump.
  double jump_max_J_ = 0.0;
  double since_zero_J_ = 0.0;
  double since_zero_max_J_ = 0.0;
};

}  // namespace palpable::haptics
