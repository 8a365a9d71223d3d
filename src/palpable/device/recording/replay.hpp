// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/hand_off.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/recording/recording.hpp"

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;

/// Gives a recording's raw positions again, one a tick, as they were read then and at their own times, so
/// that the same scene and options give the same forces to the last bit; forces are ignored. At the end the
/// position becomes stale, so the force ramps down. A thread of its own reads the file ahead, so a recording
/// of any length takes some twenty megabytes; a tick that it is late for has a stale position.
class ReplayDevice final : public Device {
 public:
  /// `reader` at its first chunk, of a recording with a tick.
  ReplayDevice(std::unique_ptr<RecordingReader> reader, const Traits& traits);
  ~ReplayDevice() override;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame>) noexcept override {}
  void stop() noexcept override {}

 private:
  void read_ahead();
  void fill();

  Traits traits_;
  std::unique_ptr<RecordingReader> reader_;
  Ring<Reading> ahead_;
  Reading last_;
  // The reading thread's: of the newest chunk, what had no room in the ring.
  const Recording* piece_ = nullptr;
  std::size_t next_ = 0;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

/// What the device gave at a recorded tick, with the tick's time. Tick path.
Reading recorded_reading(const TouchSample& tick) noexcept;

/// From `replay:FILE`. Its traits are those of the recorded device, or, where an old recording does not hold
/// them, of a device without motors. Reads the whole file once to see that it is not damaged. Errors:
/// invalid_input (not a recording, damaged, no ticks in it), usage (no file named).
Result<std::unique_ptr<Device>> open_replay(DeviceUrl& url, const OpenOptions& options);

}  // namespace palpable::device
