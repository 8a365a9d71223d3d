// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/touch_sample.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/haptics/tick/contact_transient.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>

namespace palpable::haptics {

/// How a scene takes the place of the one before.
enum class Succession : std::uint8_t {
  /// It is another one: the forces of both are cross-faded.
  replaces,
  /// It is the same surface, seen later: the surface moves from where it was to where it is, and its velocity
  /// enters damper and friction (surface_between.hpp).
  moves
};

/// What the servo loop renders. It is replaced as a whole, without a jump in the force.
struct HapticScene {
  /// Never null in a running loop.
  std::shared_ptr<const Touchable> touchable;
  /// Maps the device's workspace into the scene (rotation, translation, scale).
  Transform<SceneFrame, DeviceFrame> scene_from_device;
  /// Chosen by the caller; every sample holds the id of its scene.
  std::uint32_t id = 0;
  /// Vibration after an impact; none by default.
  ContactTransient transient = {};
  Succession succession = Succession::replaces;
};

/// Bits of TouchSample::flags: events and limits of one tick.
namespace flag {
inline constexpr std::uint32_t kContact = 1U << 0;
inline constexpr std::uint32_t kHasProxy = 1U << 1;
/// The law's force exceeded the force cap and was reduced.
inline constexpr std::uint32_t kForceCapped = 1U << 2;
/// The force rose faster than allowed; its growth was limited.
inline constexpr std::uint32_t kRiseLimited = 1U << 3;
/// The passivity controller dissipated energy.
inline constexpr std::uint32_t kPassivityActed = 1U << 4;
/// During the cross-fade between two scenes.
inline constexpr std::uint32_t kFading = 1U << 5;
/// The force is ramping to zero or back: start, pause, fault, stale source.
inline constexpr std::uint32_t kRamping = 1U << 6;
inline constexpr std::uint32_t kPaused = 1U << 7;
/// The device's reading was not finite or moved faster than a hand can. It was not used.
inline constexpr std::uint32_t kImplausible = 1U << 8;
/// The law's force was not finite. Zero was used, and the force ramps to zero.
inline constexpr std::uint32_t kNotFinite = 1U << 9;
/// The first tick of a new touch: state, velocity and energy were reset.
inline constexpr std::uint32_t kNewTouch = 1U << 10;
/// The tick was so late that the watchdog had written zero force. The force rises from zero again.
inline constexpr std::uint32_t kStalled = 1U << 11;
/// The device gave the reading before once more: it says so, or it is slower than the loop. The force was
/// held.
inline constexpr std::uint32_t kRepeated = 1U << 12;
/// No reading of this tick was used.
inline constexpr std::uint32_t kNoReading = kImplausible | kRepeated;
}  // namespace flag

/// Everything about one tick; its flags are haptics::flag's.
using TouchSample = device::TouchSample;

/// Whether a probe is present, or its force is not yet zero.
inline bool is_present(const TouchSample& sample) {
  return sample.status == device::Status::ok || sample.written_force_N.v != Vec3{};
}

/// Changes that must be reported even if a reader skips samples.
struct TouchEvent {
  enum class Kind : std::uint8_t {
    contact_made,
    contact_lost,
    /// `value` is the label of the material that was entered in contact.
    label_entered,
    /// The force ramps to zero; `value` is the device::Status.
    fault,
    /// The device works again; the force ramps up.
    recovered,
    /// The law returned a force that is not finite.
    not_finite,
    /// `value` is the id of the scene whose fade-in is complete.
    scene_changed,
    button_down,
    button_up,
    /// The motors have become so warm that the greatest force is reduced (HeatBudget); they are cool again.
    motors_warm,
    motors_cool
  };
  std::uint64_t tick = 0;
  Kind kind = Kind::contact_made;
  std::uint32_t value = 0;
  /// The probe, as in TouchSample::probe.
  std::uint8_t probe = 0;
};

/// A missed deadline and its cause, determined from the clocks.
struct MissedDeadline {
  enum class Cause : std::uint8_t {
    /// The operating system woke the thread after the deadline.
    late_wake,
    /// The thread was preempted while it polled the clock before the deadline.
    held_up_waiting,
    /// The thread was preempted during the tick: the processor time of the tick was short.
    held_up_in_tick,
    /// The computation of the tick took too long.
    slow_tick
  };
  std::uint64_t tick = 0;
  /// Number of whole periods that were skipped.
  std::uint32_t periods = 0;
  double late_us = 0.0;
  Cause cause = Cause::late_wake;
};

/// The 50th, 99th and 99.9th percentile and the maximum, in microseconds.
struct Percentiles {
  double p50 = 0.0;
  double p99 = 0.0;
  double p99_9 = 0.0;
  double max = 0.0;
};

/// Counters of a touch, whether in real time or not.
struct TickCounts {
  std::uint64_t ticks = 0;
  double max_force_N = 0.0;
  /// Of the motors now (HeatBudget::heat()).
  double heat = 0.0;
  /// Ticks in which the force cap, the rise limit and the passivity controller reduced the force.
  std::uint64_t force_capped_ticks = 0;
  std::uint64_t rise_limited_ticks = 0;
  std::uint64_t passivity_ticks = 0;
  std::uint64_t contact_ticks = 0;
  /// Number of contact transients that were started.
  std::uint64_t transients = 0;
  /// Ticks that were so late that the force had been cut to zero before them.
  std::uint64_t stalls = 0;
  /// Ticks without a valid reading or force.
  std::uint64_t fault_ticks = 0;
  /// Greatest energy generated beyond the virtual damper's reserve (passivity.hpp) and received by the hand:
  /// as it was, and as it would have been without the controller; at least what a recording shows
  /// (ShownWork). J.
  double made_max_J = 0.0;
  double made_max_without_controller_J = 0.0;
  /// The same from forces and movements alone, as a recording shows it (ShownWork::made_max_J), J; never more
  /// than made_max_J. NaN as below.
  double work_made_max_J = 0.0;
  /// The most work on the hand since the written force was last zero (ShownWork), J: with what the hand
  /// itself delivered in the same contact before a stall, so not all of it was generated. NaN while no tick
  /// was of a contact law: for others the work alone shows nothing.
  double work_since_zero_force_max_J = 0.0;
  /// Greatest energy that the rise limit withheld from a spring, J. The wall is weaker by that until the hand
  /// leaves it.
  double withheld_max_J = 0.0;
  /// The energy that changes of scene brought, J, >= 0: the work on the hand during each, and what the
  /// springs store more than before it; of a surface that moves, what its movement adds to its spring and
  /// gives through dampers and friction; of a touch that begins in contact, what its ramp loads the spring
  /// with. It is not generated by the law.
  double scene_change_J = 0.0;
  /// Time from the first tick to the first force that a hand can feel (0.02 N); NaN before it.
  double first_force_t_s = std::numeric_limits<double>::quiet_NaN();
};

struct ServoStatistics {
  TickCounts touch;
  /// Mean rate of the ticks outside rests.
  double rate_hz = 0.0;
  /// How long the loop has rested (ServoOptions::rest_after_s), and the number of ticks during rests.
  double rested_s = 0.0;
  std::uint64_t rest_ticks = 0;
  /// Number of whole periods skipped, in total and for each MissedDeadline::Cause in its order.
  std::uint64_t missed = 0;
  std::array<std::uint64_t, 4> missed_by_cause{};
  /// Time between the starts of consecutive ticks; and duration of a tick, device I/O included.
  Percentiles period_us;
  Percentiles compute_us;
  std::uint64_t allocations_in_ticks = 0;
};

}  // namespace palpable::haptics
