// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/transport/usb_transfers.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace palpable::device {

/// Reads the vendor's firmware, which the user supplies. Errors (device): missing, not a file, empty, or
/// larger than the device's memory.
Result<std::vector<std::byte>> read_falcon_firmware(const std::string& file);

/// Sets the line up for the firmware's packets, and tells whether it answers one with zero force.
bool begin_falcon_packets(UsbTransfers& usb);

/// Loads the firmware by the device's boot program, and begins its packets. Errors (device): no boot program
/// answers, a block comes back changed, or what was loaded does not answer as the Falcon's firmware.
Result<void> load_falcon_firmware(UsbTransfers& usb, const std::vector<std::byte>& image);

}  // namespace palpable::device
