// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/live/camera_link.hpp"
#include "palpable/sources/live/video_calls.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace palpable::sources {

/// The greatest number of a video device.
inline constexpr int kMostVideoDevice = 63;

/// A camera of this machine, and how it shall send its pictures.
struct VideoDevice {
  /// /dev/videoN, 0 ... kMostVideoDevice; -1: none is named, so that opening lists those that there are.
  int number = 0;
  /// Pixels; 0: as the camera is set.
  int width = 0, height = 0;
  /// Pictures a second; 0: as the camera is set. A camera that has no such rate takes another one.
  int rate_hz = 0;
  /// nullopt: JPEG if the camera has it, else YUYV.
  std::optional<CameraCoding> coding = {};
};

/// The cameras of this machine, "camera:0 (NAME), camera:2 (NAME)"; "none" if there is none.
std::string listed_cameras(VideoCalls& calls = system_video_calls());

/// Opens a camera and starts its pictures. The link is lost when the camera is unplugged or reports a fault,
/// and when no picture comes for `silence`. Pictures that the driver marks as damaged are left out. `calls`
/// must outlive it. Errors (invalid_input, without a place): no such camera (lists those that there are),
/// used by another program, not permitted, neither JPEG nor YUYV, another size than was asked for.
Result<std::unique_ptr<CameraLink>> open_video_device(
    const VideoDevice& device, VideoCalls& calls = system_video_calls(),
    std::chrono::milliseconds silence = std::chrono::seconds(5));

}  // namespace palpable::sources
