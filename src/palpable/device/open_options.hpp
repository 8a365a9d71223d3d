// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/system/hand_off.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::device {

/// Passes a pointer's position from the page to the device; nullopt = the pointer was removed. One writer
/// thread; the device reads.
using PointerFeed = LatestValue<std::optional<Point<DeviceFrame>>>;

/// Polylines along the surface of a scene, at least two points each; metres.
using SurfaceStrokes = std::vector<std::vector<Point<DeviceFrame>>>;

struct Traits;

/// Where a vendor's library is loaded, which may hang, crash or end its process.
enum class VendorLibrary : std::uint8_t {
  /// In palpable-library-host (docs/adr/0012).
  in_own_process,
  /// In this process, which is that one, or a test.
  here,
  /// The same, with a device that is only opened to be closed again: it does not move by itself.
  here_to_free_motors
};

struct OpenOptions {
  /// Seed for a device whose URL has none.
  std::uint64_t seed = 1;
  /// The loop's rate: the frequency at which read() and write() will be called.
  double rate_hz = 1000.0;
  /// The strokes with which a simulated hand explores a scene, asked once when it is opened, with its traits.
  /// Empty, or if it returns none: the hand follows a curve over its whole workspace.
  std::function<SurfaceStrokes(const Traits&)> strokes;
  /// Checks a recording's header before it is replayed (session/touch/recording_header.hpp). Empty: only the
  /// device's traits are checked. Errors: invalid_input.
  std::function<Result<void>(const std::string& header_json)> check_header;
  /// Needed by `pointer:` only.
  std::shared_ptr<PointerFeed> pointer;
  VendorLibrary vendor_library = VendorLibrary::in_own_process;
};

}  // namespace palpable::device
