// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/hand_off.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace palpable::device {

/// Where a pointer's place arrives from the page, or, empty, that it was taken away: one thread puts, the
/// device takes.
using PointerFeed = LatestValue<std::optional<Point<DeviceFrame>>>;

struct OpenOptions {
  /// For what is random and has no seed in its URL.
  std::uint64_t seed = 1;
  /// The loop's rate: how often read() and write() will be called.
  double rate_hz = 1000.0;
  /// Needed by `pointer:` only.
  std::shared_ptr<PointerFeed> pointer;
};

}  // namespace palpable::device
