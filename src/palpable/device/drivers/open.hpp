// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/open_options.hpp"
#include "palpable/device/transport/port_state.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::device {

/// Opens the device with this URL: scheme:path?name=value&name=value (docs/devices.md). Errors: usage
/// (unknown scheme or option, a value out of range), device (not present, permission denied, no answer),
/// invalid_input (a recording that cannot be read).
Result<std::unique_ptr<Device>> open_device(std::string_view url, const OpenOptions& options);

/// Opens the same device again, after it has failed. Empty for virtual devices, and for those that connect
/// again themselves (remote:).
std::function<Result<std::unique_ptr<Device>>()> reopener(const std::string& url, double rate_hz);

/// Checks that a URL is well formed, and its options, without opening anything, so that errors are reported
/// before long computations. Errors: usage.
Result<void> check_device_url(std::string_view url);

/// Checks that the devices of several hands can be open at the same time: no real one twice, no `pointer:`
/// beside others, and at most one of a vendor's library that serves only one. Errors: usage.
Result<void> check_together(const std::vector<std::string>& urls);

/// Whether a URL names a device without real motors: a simulation, the pointer, a recording.
bool is_virtual_device(std::string_view url);

/// Whether this kind of device has buttons that the driver reads.
bool has_buttons(std::string_view url);

/// How the handle must be held while this device is opened, as one sentence without a full stop; empty if
/// anyhow, or if it is not there (none is plugged in, its library or its port is missing). Looks for devices;
/// not for the tick path.
std::string hold_words(std::string_view url);

/// A kind of device that can be opened, for `palpable devices`.
struct DeviceKind {
  /// A URL for open_device(): "sim:".
  std::string url;
  std::string name;
  /// One sentence about the device.
  std::string description;
  /// Whether one can be opened on this machine now; if not, `note` gives the reason.
  bool available = true;
  /// What is at this port may be another thing: opening it tells; `note` says what the system knows of it.
  bool may_be = false;
  std::string note;
  /// And this is what to do about it, without a capital letter and a full stop.
  std::string advice;
};
std::vector<DeviceKind> list_devices();

/// What the list says of a 2DIY's port: which program holds it, and whether it is surely one.
void describe_serial_port(DeviceKind& kind, const std::string& port,
                          const std::optional<UsbIdentity>& identity);

/// Where devices of a driver that calls a vendor's library may be plugged in, by loading that library into
/// this process, which is palpable-library-host. Errors: usage (no such driver), device.
Result<std::vector<std::string>> vendor_ports(std::string_view scheme);

}  // namespace palpable::device
