// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/recording/recording.hpp"

#include <memory>
#include <vector>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;

/// Gives a recording's raw positions again, one a tick, as they were read then and at their own times, so
/// that the same scene and options give the same forces to the last bit; forces are ignored. At the end the
/// position becomes stale, so the force ramps down.
class ReplayDevice final : public Device {
 public:
  /// `ticks` must not be empty.
  ReplayDevice(std::vector<TouchSample> ticks, const Traits& traits);

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame>) noexcept override {}
  void stop() noexcept override {}

 private:
  Traits traits_;
  std::vector<TouchSample> ticks_;
  std::size_t next_ = 0;
};

/// What the device gave at a recorded tick, with the tick's time. Tick path.
Reading recorded_reading(const TouchSample& tick) noexcept;

/// From `replay:FILE`. Its traits are those of the recorded device, or, where an old recording does not hold
/// them, of a device without motors. Errors: invalid_input (not a recording, no ticks in it), usage (no file
/// named).
Result<std::unique_ptr<Device>> open_replay(DeviceUrl& url, const OpenOptions& options);

}  // namespace palpable::device
