// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/drivers/open.hpp"

#include "palpable/device/evdev/evdev.hpp"
#include "palpable/device/falcon/falcon.hpp"
#include "palpable/device/force_dimension/force_dimension.hpp"
#include "palpable/device/inverse3/inverse3.hpp"
#include "palpable/device/open_haptics/open_haptics.hpp"
#include "palpable/device/pointer/pointer.hpp"
#include "palpable/device/recording/replay.hpp"
#include "palpable/device/remote/remote_device.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/device/two_diy/two_diy.hpp"
#include "palpable/device/url.hpp"

#include <array>
#include <filesystem>
#include <set>

namespace palpable::device {
namespace {

/// One entry per driver: a new one is added only here.
struct Driver {
  std::string_view scheme;
  Result<std::unique_ptr<Device>> (*open)(DeviceUrl&, const OpenOptions&);
  std::string_view name;
  std::string_view description;
  bool is_virtual = false;
  /// How the handle is held while the device is opened, as a sentence without a full stop; empty: anyhow.
  std::string_view hold = {};
  /// What to do if there is none.
  std::string_view advice = {};
  /// Where devices of this kind may be plugged in, or why none can be; null if it needs none.
  Result<std::vector<std::string>> (*ports)() = nullptr;
  /// Checks path and options of a URL without opening it; null if open() does it first.
  Result<void> (*check)(DeviceUrl&) = nullptr;
};

Result<std::vector<std::string>> serial_ports() { return two_diy_ports(); }
Result<std::vector<std::string>> remote_ports() {
  return Error{ErrorCode::device, "needs the address that palpable share prints at the other computer", {}};
}

constexpr std::array kDrivers{
    Driver{.scheme = "pointer",
           .open = open_pointer,
           .name = "pointer",
           .description = "The page's mouse, finger, pen or arrow keys; no motors.",
           .is_virtual = true},
    Driver{.scheme = "sim",
           .open = open_simulated_hand,
           .name = "simulated hand",
           .description = "A simulated hand on a simulated device; it explores by itself.",
           .is_virtual = true},
    Driver{.scheme = "replay",
           .open = open_replay,
           .name = "replay",
           .description = "Replays the movements of a recording: replay:FILE.",
           .is_virtual = true},
    Driver{.scheme = "2diy",
           .open = open_two_diy,
           .name = "Haply 2DIY",
           .description = "A planar device on a serial port; hold its handle at home when a touch begins.",
           .hold = "Hold the handle of the 2DIY at its home: stretched away from the motors, or, of variant "
                   "v1, folded against them, and of variant 2018 with the inner links apart on one line",
           .advice = "plug in its USB cable, or name its port: 2diy:/dev/ttyACM0",
           .ports = serial_ports},
    Driver{.scheme = "falcon",
           .open = open_falcon,
           .name = "Novint Falcon",
           .description =
               "By its USB packets, with its maker's firmware in a file; pull the grip out and push it in "
               "when a touch begins.",
           .advice = "plug in its USB cable and its power supply",
           .ports = falcon_ports},
    Driver{.scheme = "forcedimension",
           .open = open_force_dimension,
           .name = "Force Dimension",
           .description =
               "An omega, delta or sigma, or a Novint Falcon, by the vendor's library libdhd; the handle "
               "moves by itself when a touch begins.",
           .hold = "Let go of the handle of the Force Dimension device: it moves by itself",
           .advice = "plug it in, and install the vendor's SDK (forcedimension.com), which has libdhd.so, or "
                     "name that file: forcedimension:?library=FILE",
           .ports = force_dimension_ports},
    Driver{.scheme = "inverse3",
           .open = open_inverse3,
           .name = "Haply Inverse3",
           .description = "Through its maker's service; hold the handle in the middle when a touch begins.",
           .hold = "Hold the handle of the Inverse3 where the middle of the scene shall be",
           .advice = "plug it in, and install and start its maker's service (haply.co), or name its port: "
                     "inverse3:?port=10001",
           .ports = inverse3_ports},
    Driver{
        .scheme = "touch",
        .open = open_open_haptics,
        .name = "3D Systems Touch, Phantom",
        .description = "By the vendor's library libHD; put the stylus into its well when a touch begins.",
        .hold =
            "Put the stylus of the 3D Systems device into its well, and take it out when the touch has begun",
        .advice =
            "plug it in, and install the vendor's OpenHaptics and device driver (3dsystems.com), which have "
            "libHD.so, or name that file: touch:?library=FILE",
        .ports = open_haptics_ports},
    Driver{.scheme = "evdev",
           .open = open_evdev,
           .name = "joystick or gamepad",
           .description = "With force feedback, in the plane; gamepads only rumble.",
           .advice = "plug in one with force feedback",
           .ports = evdev_ports},
    Driver{.scheme = "remote",
           .open = open_remote,
           .name = "device of another computer",
           .description = "Where palpable share serves it: remote:HOST:PORT?token=…, as printed there.",
           .advice = "run palpable share at the other computer",
           .ports = remote_ports,
           .check = check_remote},
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
  auto parsed = DeviceUrl::parse(url);
  if (!parsed) return std::move(parsed).error();
  const auto driver = driver_of(*parsed);
  if (!driver) return driver.error();
  if ((*driver)->check != nullptr) return (*driver)->check(*parsed);
  parsed->check_only();
  const auto refused = (*driver)->open(*parsed, {});
  return parsed->is_valid() ? Result<void>{} : Result<void>(refused.error());
}

Result<void> check_together(const std::vector<std::string>& urls) {
  if (urls.size() < 2) return {};
  std::set<std::string> seen;
  std::set<std::filesystem::path> motors;
  for (const std::string& url : urls) {
    if (auto known = check_device_url(url); !known) return known;
    auto parsed = DeviceUrl::parse(url);
    const std::string file = parsed ? parsed->take_text("motors") : std::string();
    std::error_code unknown;
    const auto path = std::filesystem::weakly_canonical(file, unknown);
    if (!file.empty() && !motors.insert(unknown ? std::filesystem::path(file) : path).second)
      return Error{ErrorCode::usage, "two devices cannot write the same file of motors", public_url(url)};
    if (url.starts_with("pointer:"))
      return Error{ErrorCode::usage, "the page's pointers touch beside devices anyway: leave it out",
                   public_url(url)};
    // Its library has one scheduler for all devices, which ends with the first that is closed.
    const std::string one = url.starts_with("touch:") ? "touch:" : url;
    if (!seen.insert(one).second && !is_virtual_device(url))
      return Error{ErrorCode::usage,
                   one == url ? "the device is named twice" : "only one device of this kind can be touched",
                   public_url(url)};
  }
  return {};
}

bool is_virtual_device(std::string_view url) {
  const auto parsed = DeviceUrl::parse(url);
  const auto driver = parsed ? driver_of(*parsed) : Result<const Driver*>(parsed.error());
  return driver && (*driver)->is_virtual;
}

std::string hold_words(std::string_view url) {
  const auto parsed = DeviceUrl::parse(url);
  const auto driver = parsed ? driver_of(*parsed) : Result<const Driver*>(parsed.error());
  return driver ? std::string((*driver)->hold) : std::string();
}

Result<std::unique_ptr<Device>> open_device(std::string_view url, const OpenOptions& options) {
  auto parsed = DeviceUrl::parse(url);
  if (!parsed) return std::move(parsed).error();
  const auto driver = driver_of(*parsed);
  if (!driver) return driver.error();
  return (*driver)->open(*parsed, options);
}

std::function<Result<std::unique_ptr<Device>>()> reopener(const std::string& url, double rate_hz) {
  if (is_virtual_device(url) || url.starts_with("remote:")) return {};
  OpenOptions options;
  options.rate_hz = rate_hz;
  return [url, options] { return open_device(url, options); };
}

std::vector<DeviceKind> list_devices() {
  std::vector<DeviceKind> kinds;
  for (const auto& driver : kDrivers) {
    const DeviceKind kind{std::string(driver.scheme) + ":",
                          std::string(driver.name),
                          std::string(driver.description),
                          true,
                          {},
                          {}};
    const auto ports = driver.ports == nullptr ? Result(std::vector<std::string>{""}) : driver.ports();
    if (ports && !ports->empty()) {
      for (const std::string& port : *ports) {
        kinds.push_back(kind);
        kinds.back().url += port;
      }
      continue;
    }
    kinds.push_back(kind);
    kinds.back().available = false;
    kinds.back().note = ports ? "none is plugged in" : ports.error().message;
    kinds.back().advice = driver.advice;
  }
  return kinds;
}

}  // namespace palpable::device
