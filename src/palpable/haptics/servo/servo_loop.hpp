// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/servo/real_time.hpp"
#include "palpable/haptics/servo/servo_types.hpp"
#include "palpable/haptics/servo/tick.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::haptics {

enum class Memory { leave, lock };
enum class Recording { off, on };

struct ServoOptions {
  /// 100…4000.
  double rate_hz = 1000.0;
  TickOptions tick;
  /// SCHED_FIFO priority asked for, 1…99; 0 = do not ask.
  int realtime_priority = 80;
  /// Locking keeps the whole process's pages in memory.
  Memory memory = Memory::lock;
  /// The last stretch before a deadline is waited for by watching the clock, for half a period at most; 0 =
  /// sleep all the way, as with every device without motors, which has no watchdog either.
  double watch_s = 150e-6;
  /// With a device that may rest (device::Traits::may_rest): after this time without a change of any probe
  /// (RestDetector), the loop ticks once per rest_period_s until something changes, with the period of its
  /// rate as dt. It never rests while it records. Infinity = never.
  double rest_after_s = 1.0;
  /// 0.001 to 0.1.
  double rest_period_s = 0.02;
  /// Samples kept for a recorder that is late: 4 s at 4 kHz.
  std::size_t recording_capacity = 16384;
  /// On from the first tick on, or by record().
  Recording recording = Recording::off;
};

/// The tick's options as a loop of this rate uses them: what depends on the rate is set.
TickOptions tick_options(const ServoOptions& options);

/// At most so many probes at once in a loop: the hand's and nine more, a person's fingers.
inline constexpr std::size_t kMaxLiveProbes = 10;

/// Runs the tick of docs/real-time.md on its own thread at a steady rate. Owns the device from begin to end:
/// every way out, the destructor included, writes zero force. Probe 0 is the hand at the device; further
/// probes, which have no motors, touch the same scene in the same tick, each with a TickPipeline of its own
/// (its own state, proxy and ramp). One thread at a time calls a method that is not const; samples, events
/// and recordings are each taken by one thread.
class ServoLoop {
 public:
  /// Starts the thread; the force rises from zero. `device` and scene.touchable must not be null; `further`
  /// are where probes 1, 2 ... come from, kMaxLiveProbes - 1 at most, none of which pushes back. Errors
  /// (usage): a rate, cap or time outside its range.
  static Result<std::unique_ptr<ServoLoop>> start(std::unique_ptr<device::Device> device, HapticScene scene,
                                                  const ServoOptions& options,
                                                  std::vector<std::unique_ptr<device::Device>> further = {});
  ~ServoLoop();
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  /// Hands over a new scene; the servo fades to it as soon as it is not fading already, and a scene
  /// handed over before that replaces one that still waits. Reads the model's pages first. Old scenes are
  /// freed by later calls of this and by the destructor, never by the servo.
  void change(HapticScene scene);
  /// Force to zero and held there, or back.
  void pause();
  void resume();
  /// Ends the thread with zero force written; returns when it has. More than once is allowed.
  void stop();

  /// A probe's newest sample if one came since the last call; nothing of a probe that there is not.
  std::optional<TouchSample> take_latest(std::size_t probe = 0);
  std::optional<TouchEvent> take_event();
  std::optional<MissedDeadline> take_missed();
  /// While on, every tick's sample goes into the recording ring, after it those of further probes that are
  /// there.
  void record(Recording recording);
  bool is_recording() const;
  std::optional<TouchSample> take_recorded();
  /// Samples that found the ring full.
  std::uint64_t recording_lost() const;

  /// A copy a few milliseconds old; exact after stop(). The touch counted is the hand's; times and
  /// allocations are those of all probes together.
  ServoStatistics statistics() const;
  /// Complete once the servo has ticked.
  RealTimeOutcome real_time() const;
  const device::Traits& device_traits() const;
  std::string device_fault() const;

 private:
  struct Impl;
  explicit ServoLoop(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable::haptics
