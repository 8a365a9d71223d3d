// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/drivers/open.hpp"

#include "palpable/device/evdev/evdev.hpp"
#include "palpable/device/falcon/falcon.hpp"
#include "palpable/device/force_dimension/force_dimension.hpp"
#include "palpable/device/hosted/hosted_device.hpp"
#include "palpable/device/inverse3/inverse3.hpp"
#include "palpable/device/open_haptics/open_haptics.hpp"
#include "palpable/device/pointer/pointer.hpp"
#include "palpable/device/recording/replay.hpp"
#include "palpable/device/remote/remote_device.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/device/two_diy/two_diy.hpp"
#include "palpable/device/url.hpp"

#include <array>
#include <chrono>
#include <filesystem>
#include <set>
#include <system_error>

#include <sys/stat.h>

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
  /// Adds to the entry of the list what is known of this port; null: nothing.
  void (*describe)(DeviceKind&, const std::string& port) = nullptr;
  bool has_buttons = true;
  /// It calls a vendor's library, so that it runs in a process of its own.
  bool calls_vendor = false;
};

Result<std::vector<std::string>> serial_ports() { return two_diy_ports(); }
void describe_port(DeviceKind& kind, const std::string& port) {
  describe_serial_port(kind, port, usb_identity(port));
}
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
           .ports = serial_ports,
           .describe = describe_port,
           .has_buttons = false},
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
           .ports = force_dimension_ports,
           .calls_vendor = true},
    Driver{.scheme = "inverse3",
           .open = open_inverse3,
           .name = "Haply Inverse3",
           .description = "Through its maker's service; hold the handle in the middle when a touch begins.",
           .hold = "Hold the handle of the Inverse3 where the middle of the scene shall be",
           .advice = "plug it in, and install and start its maker's service (haply.co), or name its port: "
                     "inverse3:?port=10001",
           .ports = inverse3_ports,
           .has_buttons = false},
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
        .ports = open_haptics_ports,
        .calls_vendor = true},
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

Result<const Driver*> driver_named_by(std::string_view url) {
  const auto parsed = DeviceUrl::parse(url);
  return parsed ? driver_of(*parsed) : Result<const Driver*>(parsed.error());
}

/// The same for all names of one file or device: links, and ways through other folders. It need not exist.
std::string identity_of(const std::string& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) == 0)
    return std::to_string(file.st_dev) + ":" + std::to_string(file.st_ino);
  std::error_code unknown;
  const auto real = std::filesystem::weakly_canonical(path, unknown);
  return unknown ? path : real.string();
}

/// Calls the driver's open(), for one that calls a vendor's library only where that may be.
Result<std::unique_ptr<Device>> open_by(const Driver& driver, DeviceUrl& url, const OpenOptions& options) {
  if (!driver.calls_vendor) return driver.open(url, options);
  constexpr int kLonger_s = 30, kLongest_s = 300;
  const std::chrono::seconds patience(url.take_count("patience", kLonger_s, 1, kLongest_s));
  if (options.vendor_library != VendorLibrary::in_own_process) return driver.open(url, options);
  url.check_only();
  auto refused = driver.open(url, options);
  if (!url.is_valid()) return refused;
  auto device = HostedDevice::open(url.text(), options.rate_hz, patience);
  if (!device) return std::move(device).error();
  return std::unique_ptr<Device>(*std::move(device));
}

Result<std::unique_ptr<Device>> open_named(std::string_view url, const OpenOptions& options) {
  auto parsed = DeviceUrl::parse(url);
  if (!parsed) return std::move(parsed).error();
  const auto driver = driver_of(*parsed);
  if (!driver) return driver.error();
  return open_by(**driver, *parsed, options);
}

Result<std::vector<std::string>> ports_of(const Driver& driver) {
  if (driver.ports == nullptr) return std::vector<std::string>{""};
  return driver.calls_vendor ? hosted_ports(std::string(driver.scheme)) : driver.ports();
}

}  // namespace

Result<void> check_device_url(std::string_view url) {
  auto parsed = DeviceUrl::parse(url);
  if (!parsed) return std::move(parsed).error();
  const auto driver = driver_of(*parsed);
  if (!driver) return driver.error();
  if ((*driver)->check != nullptr) return (*driver)->check(*parsed);
  parsed->check_only();
  OpenOptions options;
  options.vendor_library = VendorLibrary::here;
  const auto refused = open_by(**driver, *parsed, options);
  return parsed->is_valid() ? Result<void>{} : Result<void>(refused.error());
}

Result<void> check_together(const std::vector<std::string>& urls) {
  if (urls.size() < 2) return {};
  std::set<std::string> seen, motors;
  for (const std::string& url : urls) {
    if (auto known = check_device_url(url); !known) return known;
    auto parsed = DeviceUrl::parse(url);
    const std::string file = parsed ? parsed->take_text("motors") : std::string();
    if (!file.empty() && !motors.insert(identity_of(file)).second)
      return Error{ErrorCode::usage, "two devices cannot write the same file of motors", url_as_place(url)};
    if (url.starts_with("pointer:"))
      return Error{ErrorCode::usage, "the page's pointers touch beside devices anyway: leave it out",
                   url_as_place(url)};
    // Its library has one scheduler for all devices, which ends with the first that is closed.
    const std::string path = parsed ? parsed->path() : std::string();
    const std::string one = url.starts_with("touch:")     ? "touch:"
                            : path.find('/') == path.npos ? url
                                                          : parsed->scheme() + ":" + identity_of(path);
    if (!seen.insert(one).second && !is_virtual_device(url))
      return Error{
          ErrorCode::usage,
          one == "touch:" ? "only one device of this kind can be touched" : "the device is named twice",
          url_as_place(url)};
  }
  return {};
}

bool is_virtual_device(std::string_view url) {
  const auto driver = driver_named_by(url);
  return driver && (*driver)->is_virtual;
}

bool has_buttons(std::string_view url) {
  const auto driver = driver_named_by(url);
  return driver && (*driver)->has_buttons;
}

std::string hold_words(std::string_view url) {
  const auto driver = driver_named_by(url);
  if (!driver) return {};
  if ((*driver)->hold.empty()) return {};
  // Nobody holds a device that is not there, or whose library is not. Who names an option knows more than the
  // list.
  if (url.ends_with(':')) {
    const auto ports = ports_of(**driver);
    if (!ports || ports->empty()) return {};
  }
  const auto parsed = DeviceUrl::parse(url);
  const std::string path = parsed ? parsed->path() : std::string();
  std::error_code unknown;
  if (path.starts_with('/') && !std::filesystem::exists(path, unknown)) return {};
  return std::string((*driver)->hold);
}

Result<std::unique_ptr<Device>> open_device(std::string_view url, const OpenOptions& options) {
  auto device = open_named(url, options);
  const auto driver = driver_named_by(url);
  // A library that is not there: what the list of devices advises.
  if (!device && driver && (*driver)->calls_vendor && url.ends_with(':') && !ports_of(**driver)) {
    Error error = std::move(device).error();
    error.message += ": " + std::string((*driver)->advice);
    return error;
  }
  return device;
}

void describe_serial_port(DeviceKind& kind, const std::string& port,
                          const std::optional<UsbIdentity>& identity) {
  if (!identity || !is_surely_two_diy(*identity)) {
    kind.may_be = true;
    const std::string name = !identity                   ? std::string()
                             : identity->product.empty() ? "USB " + identity->numbers
                                                         : identity->product + ", USB " + identity->numbers;
    kind.note = "a serial port that may be one" + (name.empty() ? "" : " (" + name + ")");
  }
  if (const auto holder = holder_of(port)) {
    kind.available = false;
    kind.note += (kind.note.empty() ? "" : ", ") + ("in use by " + holder->words());
    kind.advice = "end that program";
  }
}

Result<std::vector<std::string>> vendor_ports(std::string_view scheme) {
  for (const auto& driver : kDrivers)
    if (driver.calls_vendor && driver.scheme == scheme) return driver.ports();
  return Error{ErrorCode::usage, "no driver of this name calls a vendor's library", std::string(scheme)};
}

std::function<Result<std::unique_ptr<Device>>()> reopener(const std::string& url, double rate_hz) {
  if (is_virtual_device(url) || url.starts_with("remote:")) return {};
  OpenOptions options;
  options.rate_hz = rate_hz;
  return [url, options] { return open_named(url, options); };
}

std::vector<DeviceKind> list_devices() {
  std::vector<DeviceKind> kinds;
  for (const auto& driver : kDrivers) {
    const DeviceKind kind{std::string(driver.scheme) + ":",
                          std::string(driver.name),
                          std::string(driver.description),
                          true,
                          false,
                          {},
                          {}};
    const auto ports = ports_of(driver);
    if (ports && !ports->empty()) {
      for (const std::string& port : *ports) {
        kinds.push_back(kind);
        kinds.back().url += port;
        if (driver.describe != nullptr) driver.describe(kinds.back(), port);
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
