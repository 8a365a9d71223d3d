// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/child_process.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/hosted/exchange.hpp"
#include "palpable/device/hosted/host_process.hpp"
#include "palpable/device/transport/fresh_reading.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace palpable::device {

/// A device whose driver runs in another process, `palpable-library-host`, because it calls a vendor's
/// library, which may hang, crash or end its process (docs/adr/0012). The servo's thread asks the host for a
/// position in each tick and waits for at most kPatience; a force is passed without waiting. If the servo
/// does not write for 5 ms, or this program ends in any way, the host frees the motors by the library. If the
/// host ends, or is in a call of the library for kHungCall, a thread ends it, frees the motors by a new host,
/// and the device has failed.
class HostedDevice final : public Device {
 public:
  /// The time for the answer of a host in a tick, but not longer than two periods.
  static constexpr std::chrono::microseconds kPatience{2000};

  /// Opens `url` in a new host, within `longest`. Errors: those of the driver; device, if the library ends
  /// its process or does not return; failed, if the host cannot be started.
  static Result<std::unique_ptr<HostedDevice>> open(const std::string& url, double rate_hz,
                                                    std::chrono::milliseconds longest);
  /// Frees the motors, and ends the host, also if the library hangs.
  ~HostedDevice() override;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void stop() noexcept override;
  std::string fault() const override;
  std::string guidance() const override;

 private:
  HostedDevice(std::string url, Traits traits, HostProcess host, double rate_hz);
  void watch() noexcept;
  /// The host ended or hangs: ends it, and frees the motors by a new one.
  void give_up(const std::string& what);
  void take_texts() const;

  const std::string url_;
  const Traits traits_;
  HostProcess host_;
  const std::int64_t patience_ns_;
  FreshReading fresh_;
  /// What the host answered last. The servo's thread only.
  HostExchange::State state_;
  std::atomic<bool> ending_{false};
  std::atomic<bool> failed_{false};
  mutable std::mutex mutex_;
  // Under the mutex.
  std::string failure_;
  mutable HostExchange::Texts texts_;
  std::thread watch_;
};

/// Where devices of this scheme may be plugged in, as the driver's library says, asked in a process of its
/// own. Errors: device, failed.
Result<std::vector<std::string>> hosted_ports(const std::string& scheme);

}  // namespace palpable::device
