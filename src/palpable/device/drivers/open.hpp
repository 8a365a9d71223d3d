// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/open_options.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::device {

/// Opens what a URL names: scheme, then what the scheme takes, then ?name=value&name=value. docs/devices.md
/// lists them. Errors: usage (unknown scheme or option, a value out of range), device (not there, no
/// permission, no answer), invalid_input (a recording that cannot be read).
Result<std::unique_ptr<Device>> open_device(std::string_view url, const OpenOptions& options);

/// Whether a URL is well formed and names a kind of device that there is, without opening one: said before
/// long work begins. Errors: usage.
Result<void> check_device_url(std::string_view url);

/// Whether a URL names a device that moves no motor: a simulation, the pointer, a recording.
bool is_virtual_device(std::string_view url);

/// A kind of device that can be opened, for `palpable devices`.
struct DeviceKind {
  /// What open_device() takes: "sim:".
  std::string url;
  std::string name;
  /// One sentence.
  std::string description;
  /// Whether one can be opened here and now; if not, `note` says why.
  bool available = true;
  std::string note;
};
std::vector<DeviceKind> list_devices();

}  // namespace palpable::device
