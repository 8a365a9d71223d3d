// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace palpable::device {

/// How another process sets a device's motors to zero force: it writes these bytes to `descriptor`, from the
/// start of a file, or appended to a stream (a serial line, a socket).
struct ZeroWrite {
  /// The device's own descriptor; it stays open while the device exists.
  int descriptor = -1;
  std::vector<std::byte> bytes;
  /// Not 0: the descriptor is a USB device's, and the bytes are sent to this endpoint in one bulk transfer.
  std::uint8_t usb_endpoint = 0;
};

/// An additional interface of devices whose force another process can cut (haptics/safety/guardian.hpp).
class Guardable {
 public:
  virtual ~Guardable() = default;
  /// nullopt if the device was opened without such a way. Not for the tick path.
  virtual std::optional<ZeroWrite> zero_write() const = 0;
};

}  // namespace palpable::device
