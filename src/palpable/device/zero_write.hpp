// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace palpable::device {

/// How another process takes all force from a device's motors: by writing these bytes to `descriptor`, from
/// its start where it has one (a file), else as they come (a serial line, a socket).
struct ZeroWrite {
  /// The device's own; it stays open while the device lives.
  int descriptor = -1;
  std::vector<std::byte> bytes;
};

/// What a device is too if another process can take the force from its motors (haptics/safety/guardian.hpp).
class Guardable {
 public:
  virtual ~Guardable() = default;
  /// None where the device was opened without such a way. Outside the tick.
  virtual std::optional<ZeroWrite> zero_write() const = 0;
};

}  // namespace palpable::device
