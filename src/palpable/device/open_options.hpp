// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/hand_off.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace palpable::device {

/// Passes a pointer's position from the page to the device; nullopt = the pointer was removed. One writer
/// thread; the device reads.
using PointerFeed = LatestValue<std::optional<Point<DeviceFrame>>>;

struct OpenOptions {
  /// Seed for a device whose URL has none.
  std::uint64_t seed = 1;
  /// The loop's rate: the frequency at which read() and write() will be called.
  double rate_hz = 1000.0;
  /// Needed by `pointer:` only.
  std::shared_ptr<PointerFeed> pointer;
};

}  // namespace palpable::device
