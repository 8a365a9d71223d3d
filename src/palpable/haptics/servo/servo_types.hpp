// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/touch_sample.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/haptics/servo/contact_transient.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>

namespace palpable::haptics {

/// What the servo loop renders: swapped as a whole, without a jump in the force.
struct HapticScene {
  /// Never null in a running loop.
  std::shared_ptr<const Touchable> touchable;
  /// Places (and scales) the device's workspace in the scene.
  Transform<SceneFrame, DeviceFrame> scene_from_device;
  /// Chosen by the caller; every sample says in which scene it was made.
  std::uint32_t id = 0;
  /// How the surface vibrates when it is struck; not at all unless set.
  ContactTransient transient = {};
};

/// What was special in a tick. Flags of TouchSample::flags.
namespace flag {
inline constexpr std::uint32_t kContact = 1U << 0;
inline constexpr std::uint32_t kHasProxy = 1U << 1;
/// The law asked for more than the device's greatest force; it was shortened.
inline constexpr std::uint32_t kForceCapped = 1U << 2;
/// The force rose faster than allowed; the rise was shortened.
inline constexpr std::uint32_t kRateCapped = 1U << 3;
/// The passivity controller took energy out.
inline constexpr std::uint32_t kPassivityActed = 1U << 4;
/// Between two scenes.
inline constexpr std::uint32_t kFading = 1U << 5;
/// The force is on its way to zero or back: pause, fault, stale source, start.
inline constexpr std::uint32_t kRamping = 1U << 6;
inline constexpr std::uint32_t kPaused = 1U << 7;
/// The device's reading was not finite or jumped faster than a hand can: it was not used.
inline constexpr std::uint32_t kImplausible = 1U << 8;
/// The law's force was not finite: zero was used, and the force ramps down.
inline constexpr std::uint32_t kNotFinite = 1U << 9;
/// The first tick of a new touch (state, velocity and energy began anew).
inline constexpr std::uint32_t kNewTouch = 1U << 10;
/// The tick came so late that the watchdog had written zero force: the force began anew.
inline constexpr std::uint32_t kStalled = 1U << 11;
}  // namespace flag

/// Everything about one tick; its flags are haptics::flag's.
using TouchSample = device::TouchSample;

/// Whether a probe is there, or still on its way out.
inline bool is_present(const TouchSample& sample) {
  return sample.status == device::Status::ok || sample.written_force_N.v != Vec3{};
}

/// What must not be lost between two evaluations at the latest sample.
struct TouchEvent {
  enum class Kind : std::uint8_t {
    contact_made,
    contact_lost,
    /// `value` is the label entered while in contact.
    label_entered,
    /// The force ramps to zero; `value` is the device::Status.
    fault,
    /// The device answers again; the force comes back slowly.
    recovered,
    /// The law gave a force that is not finite.
    not_finite,
    /// `value` is the id of the scene that is now fully faded in.
    scene_changed,
    button_down,
    button_up
  };
  std::uint64_t tick = 0;
  Kind kind = Kind::contact_made;
  std::uint32_t value = 0;
  /// Whose it is: TouchSample::probe.
  std::uint8_t probe = 0;
};

/// A deadline that was missed, and what the clock says about why.
struct MissedDeadline {
  enum class Cause : std::uint8_t {
    /// The operating system woke the thread after the deadline.
    late_wake,
    /// The thread was taken off the processor while it waited in the last microseconds.
    held_up_waiting,
    /// The thread was taken off the processor during the tick: its own processor time was short.
    held_up_in_tick,
    /// The tick itself was too long: ours to mend.
    slow_tick
  };
  std::uint64_t tick = 0;
  /// Whole periods skipped.
  std::uint32_t periods = 0;
  double late_us = 0.0;
  Cause cause = Cause::late_wake;
};

/// The 50th, 99th and 99.9th percentile and the greatest, in microseconds.
struct Percentiles {
  double p50 = 0.0;
  double p99 = 0.0;
  double p99_9 = 0.0;
  double max = 0.0;
};

/// What a touch counted, whatever ran it.
struct TickCounts {
  std::uint64_t ticks = 0;
  double max_force_N = 0.0;
  /// Ticks in which the force cap shortened the force; likewise for the rate cap and the controller.
  std::uint64_t clamped_ticks = 0;
  std::uint64_t rate_capped_ticks = 0;
  std::uint64_t passivity_ticks = 0;
  std::uint64_t contact_ticks = 0;
  /// Contact transients that began.
  std::uint64_t transients = 0;
  /// Ticks that came so late that the force had been cut to zero before them.
  std::uint64_t stalls = 0;
  /// Ticks without a valid reading or force.
  std::uint64_t fault_ticks = 0;
  /// Greatest energy made beyond the virtual damper's reserve (passivity.hpp), as the hand received it, and
  /// had the controller not been there.
  double made_max_J = 0.0;
  double made_max_without_controller_J = 0.0;
  /// The greatest energy that the rise limit kept back from a spring: the wall is weaker by it until the hand
  /// leaves.
  double withheld_max_J = 0.0;
  /// Work done on the hand while one scene gave way to another: the change's, not the law's.
  double scene_change_J = 0.0;
  /// Since the first tick, to the first force that a hand can feel (0.02 N); NaN before it.
  double first_force_t_s = std::numeric_limits<double>::quiet_NaN();
};

struct ServoStatistics {
  TickCounts touch;
  /// Of the ticks outside rests.
  double rate_hz = 0.0;
  /// How long the loop has rested (ServoOptions::rest_after_s), and its ticks meanwhile.
  double rested_s = 0.0;
  std::uint64_t rest_ticks = 0;
  /// Whole periods skipped, and how many of them for each MissedDeadline::Cause in its order.
  std::uint64_t missed = 0;
  std::array<std::uint64_t, 4> missed_by_cause{};
  /// From one tick's begin to the next's; and a tick's own length, device exchange included.
  Percentiles period_us;
  Percentiles compute_us;
  std::uint64_t allocations_in_ticks = 0;
};

}  // namespace palpable::haptics
