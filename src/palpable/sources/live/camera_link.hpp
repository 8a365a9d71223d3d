// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace palpable::sources {

/// How the bytes of a camera's picture are to be read: a JPEG file, or two pixels in four bytes (Y U Y V,
/// BT.601 of limited range).
enum class CameraCoding : std::uint8_t { jpeg, yuyv };

/// A picture as a camera sends it; untrusted.
struct CameraFrame {
  /// Counted from 0 with every picture of the camera, also those that nobody took.
  std::uint64_t number = 0;
  std::chrono::steady_clock::time_point arrival;
  CameraCoding coding = CameraCoding::jpeg;
  /// Pixels, of yuyv only.
  int width = 0, height = 0;
  std::vector<std::byte> bytes;
};

/// The connection to one camera: opened by opening it, lost for good at its first error. One thread.
class CameraLink {
 public:
  CameraLink() = default;
  virtual ~CameraLink() = default;
  CameraLink(const CameraLink&) = delete;
  CameraLink& operator=(const CameraLink&) = delete;

  /// The newest picture since the last call, its number counted from this link's first; waits for one at most
  /// `longest`. nullopt: none yet. Errors (invalid_input or failed, without a place): the link is lost.
  virtual Result<std::optional<CameraFrame>> next(std::chrono::milliseconds longest) = 0;
};

/// Opens a link, within two seconds. Errors as CameraLink::next().
using OpenLink = std::function<Result<std::unique_ptr<CameraLink>>()>;

}  // namespace palpable::sources
