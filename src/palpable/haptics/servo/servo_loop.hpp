// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/servo/real_time.hpp"
#include "palpable/haptics/servo/servo_options.hpp"
#include "palpable/haptics/tick/servo_types.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::haptics {

/// Greatest number of probes in a loop: the one at the device and nine more (ten fingers).
inline constexpr std::size_t kMaxLiveProbes = 10;

/// Runs the tick of docs/real-time.md on a separate thread at a steady rate. It owns the device for its whole
/// lifetime: however it ends, the destructor included, it writes zero force. Probe 0 is the hand at the
/// device. Further probes have no motors; they touch the same scene in the same tick, each with its own
/// TickPipeline (its own state, proxy and ramp). Methods that are not const must be called by one thread at a
/// time; samples, events and recordings are each taken by one thread.
class ServoLoop {
 public:
  /// Starts the thread; the force rises from zero. `device` and scene.touchable must not be null. `further`
  /// gives the positions of probes 1, 2, ...; at most kMaxLiveProbes - 1 devices, all without motors. Errors
  /// (usage): a rate, cap or time outside its range; traits of a device that device::check() refuses.
  static Result<std::unique_ptr<ServoLoop>> start(std::unique_ptr<device::Device> device, HapticScene scene,
                                                  const ServoOptions& options,
                                                  std::vector<std::unique_ptr<device::Device>> further = {});
  ~ServoLoop();
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  /// Hands over a new scene. The servo cross-fades to it as soon as no other fade is running. A scene that
  /// still waits is replaced. The model's pages are read first, on the calling thread. Old scenes are freed
  /// by later calls and by the destructor, never by the servo thread.
  void change(HapticScene scene);
  /// Ramps the force to zero and holds it there; resume() ramps it back.
  void pause();
  void resume();
  /// Writes zero force, ends the thread and waits for it. May be called more than once.
  void stop();

  /// A probe's newest sample, if there is one since the last call; nullopt for a probe that does not exist.
  std::optional<TouchSample> take_latest(std::size_t probe = 0);
  std::optional<TouchEvent> take_event();
  std::optional<MissedDeadline> take_missed();
  /// While on, every tick's sample is written to the recording ring, followed by those of the further probes
  /// that are present.
  void record(Recording recording);
  bool is_recording() const;
  std::optional<TouchSample> take_recorded();
  /// Number of samples that were lost because the ring was full.
  std::uint64_t recording_lost() const;

  /// A copy that is a few milliseconds old; exact after stop(). The touch counts are those of the hand; times
  /// and allocations are those of all probes together.
  ServoStatistics statistics() const;
  /// Complete after the first tick.
  RealTimeOutcome real_time() const;
  const device::Traits& device_traits() const;
  /// The status of the device's newest reading.
  device::Status device_status() const;
  /// The device's description of its fault; empty if there is none.
  std::string device_fault() const;
  /// What the person does next so that the device becomes ready; empty if nothing.
  std::string device_guidance() const;

 private:
  struct Impl;
  explicit ServoLoop(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable::haptics
