// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace palpable::sources {

/// How the bytes of a camera's picture are to be read: a JPEG file, two pixels in four bytes (Y U Y V, BT.601
/// of limited range), or rows of RGB, one byte each.
enum class CameraCoding : std::uint8_t { jpeg, yuyv, rgb };

/// A picture as a camera sends it; untrusted.
struct CameraFrame {
  /// Counted from 0 with every picture of the camera, also those that nobody took.
  std::uint64_t number = 0;
  std::chrono::steady_clock::time_point arrival;
  CameraCoding coding = CameraCoding::jpeg;
  /// Pixels, of yuyv and rgb only.
  int width = 0, height = 0;
  std::vector<std::byte> bytes;
};

/// What a depth camera saw: depths with the camera that they belong to, and the colours of the same pixels if
/// it gives some.
struct DepthFrame {
  /// As CameraFrame::number.
  std::uint64_t number = 0;
  std::chrono::steady_clock::time_point arrival;
  DepthMap depth;
  std::optional<Image> colour;
};

/// The connection to one camera that gives frames of this type: opened by opening it, lost for good at its
/// first error. One thread.
template <class Frame>
class CameraLinkOf {
 public:
  CameraLinkOf() = default;
  virtual ~CameraLinkOf() = default;
  CameraLinkOf(const CameraLinkOf&) = delete;
  CameraLinkOf& operator=(const CameraLinkOf&) = delete;

  /// The newest frame since the last call, its number counted from this link's first; waits for one at most
  /// `longest`. nullopt: none yet. Errors (invalid_input or failed, without a place): the link is lost.
  virtual Result<std::optional<Frame>> next(std::chrono::milliseconds longest) = 0;
};
using CameraLink = CameraLinkOf<CameraFrame>;
using DepthCameraLink = CameraLinkOf<DepthFrame>;

/// Opens a link, within a few seconds. Errors as CameraLinkOf::next().
template <class Frame>
using OpenLinkOf = std::function<Result<std::unique_ptr<CameraLinkOf<Frame>>>()>;
using OpenLink = OpenLinkOf<CameraFrame>;

}  // namespace palpable::sources
