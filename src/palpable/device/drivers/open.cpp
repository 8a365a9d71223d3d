// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/drivers/open.hpp"

#include "palpable/device/pointer/pointer.hpp"
#include "palpable/device/recording/replay.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/device/two_diy/two_diy.hpp"
#include "palpable/device/url.hpp"

#include <array>

namespace palpable::device {
namespace {

/// One line per driver: a new one is added only here.
struct Driver {
  std::string_view scheme;
  Result<std::unique_ptr<Device>> (*open)(DeviceUrl&, const OpenOptions&);
  std::string_view name;
  std::string_view description;
  bool is_virtual = false;
  /// Where devices of this kind may be plugged in; null if it needs none.
  std::vector<std::string> (*ports)() = nullptr;
};

constexpr std::array kDrivers{
    Driver{"pointer", open_pointer, "pointer", "The page's mouse, finger, pen or arrow keys; no motors.",
           true},
    Driver{"sim", open_simulated_hand, "simulated hand",
           "A simulated hand on a simulated device; it explores by itself.", true},
    Driver{"replay", open_replay, "replay", "Replays the movements of a recording: replay:FILE.", true},
    Driver{"2diy", open_two_diy, "Haply 2DIY",
           "A planar device on a serial port; hold its handle at home when a touch begins.", false,
           two_diy_ports},
};

Result<const Driver*> driver_of(const DeviceUrl& url) {
  std::string known;
  for (const auto& driver : kDrivers) {
    if (driver.scheme == url.scheme()) return &driver;
    known += (known.empty() ? "" : ", ") + std::string(driver.scheme) + ":";
  }
  return Error{ErrorCode::usage, "there is no device " + url.scheme() + ": (known: " + known + ")", {}};
}

}  // namespace

Result<void> check_device_url(std::string_view url) {
  const auto parsed = DeviceUrl::parse(url);
  if (!parsed) return parsed.error();
  const auto driver = driver_of(*parsed);
  if (!driver) return driver.error();
  return {};
}

bool is_virtual_device(std::string_view url) {
  const auto parsed = DeviceUrl::parse(url);
  const auto driver = parsed ? driver_of(*parsed) : Result<const Driver*>(parsed.error());
  return driver && (*driver)->is_virtual;
}

Result<std::unique_ptr<Device>> open_device(std::string_view url, const OpenOptions& options) {
  auto parsed = DeviceUrl::parse(url);
  if (!parsed) return std::move(parsed).error();
  const auto driver = driver_of(*parsed);
  if (!driver) return driver.error();
  return (*driver)->open(*parsed, options);
}

std::vector<DeviceKind> list_devices() {
  std::vector<DeviceKind> kinds;
  for (const auto& driver : kDrivers) {
    const DeviceKind kind{std::string(driver.scheme) + ":",
                          std::string(driver.name),
                          std::string(driver.description),
                          true,
                          {}};
    const auto ports = driver.ports == nullptr ? std::vector<std::string>{""} : driver.ports();
    for (const std::string& port : ports) {
      kinds.push_back(kind);
      kinds.back().url += port;
    }
    if (!ports.empty()) continue;
    kinds.push_back(kind);
    kinds.back().available = false;
    kinds.back().note = "none is plugged in";
  }
  return kinds;
}

}  // namespace palpable::device
