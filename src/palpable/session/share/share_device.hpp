// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace palpable::session {

struct ShareOptions {
  std::string device_url;
  /// As device::HostOptions.
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;
  haptics::ServoOptions servo;
  std::uint64_t seed = 1;
  double hand_damping_Ns_per_m = haptics::kLeastHandDamping_Ns_per_m;
  /// Seconds; infinity: until cancelled.
  double seconds = std::numeric_limits<double>::infinity();
  /// Called with each new address, which a client opens: "PORT?token=...", and with each sentence about
  /// clients and the device. By two threads, never at the same time; may not be empty.
  std::function<void(std::uint16_t port, const std::string& token)> on_address;
  std::function<void(const std::string&)> on_news;
};

/// Opens a device and serves it to other computers (device/remote/remote_host.hpp) until the time is over or
/// the work is cancelled. A loop of its own computes the forces here, with all limits, the watchdog and the
/// guardian of a touch. Returns its statistics. Errors: device, usage, failed.
Result<haptics::ServoStatistics> share_device(const ShareOptions& options, const Work& work);

}  // namespace palpable::session
