// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/recording/recording.hpp"

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;

/// Replays a recording's raw positions, one per tick, with their recorded times. So the same scene and
/// options give the same forces to the last bit; written forces are ignored. At the end the position becomes
/// stale, so that the force ramps down. A separate thread reads the file ahead, so a recording of any length
/// takes about twenty megabytes. If it is late for a tick, that tick's position is stale.
class ReplayDevice final : public Device {
 public:
  /// `reader` must be at its first chunk and contain at least one tick.
  ReplayDevice(std::unique_ptr<RecordingReader> reader, const Traits& traits);
  ~ReplayDevice() override;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame>) noexcept override {}
  void stop() noexcept override {}
  /// That the recording has ended, as soon as it has.
  std::string fault() const override;

 private:
  void read_ahead();
  void fill();

  Traits traits_;
  double period_s_;
  std::unique_ptr<RecordingReader> reader_;
  Ring<Reading> ahead_;
  Reading last_;
  /// Everything of the recording is in the ring or was taken from it.
  std::atomic<bool> all_read_{false};
  // Used by the reading thread: the part of the newest chunk that did not fit into the ring.
  const Recording* piece_ = nullptr;
  std::size_t next_ = 0;
  std::atomic<bool> ending_{false};
  std::atomic<bool> has_ended_{false};
  std::thread thread_;
};

/// The device's reading at a recorded tick, with the tick's time. Tick path.
Reading recorded_reading(const TouchSample& tick) noexcept;

/// Opens `replay:FILE`. The traits are those of the recorded device; an old recording without traits gives a
/// device without motors. Reads the whole file once to check that it is not damaged. Errors: invalid_input
/// (not a recording, damaged, wrong times, a wrong header, no ticks), usage (no file named).
Result<std::unique_ptr<Device>> open_replay(DeviceUrl& url, const OpenOptions& options);

}  // namespace palpable::device
