// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/live/camera_link.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace palpable::sources {

/// A depth camera of this machine, read by a library that is opened at run time: OpenNI 2 (Orbbec,
/// PrimeSense, Asus Xtion, Kinect v1), libfreenect (Kinect v1) or librealsense 2 (Intel RealSense).
struct DepthCamera {
  enum class Kind : std::uint8_t { openni, freenect, realsense };
  Kind kind = Kind::openni;
  /// Place in the library's list of cameras, from 0.
  int number = 0;
  /// File of the library; empty: where the system looks for libraries.
  std::string library;
  /// A camera that gives no depth for this time is lost.
  std::chrono::milliseconds silence{5000};
};

/// Highest DepthCamera::number.
inline constexpr int kMostDepthCamera = 63;

/// "OpenNI", "libfreenect", "librealsense".
const char* library_name(DepthCamera::Kind kind);

/// Opens the camera and starts depth and, if it has them, colours. Depths are along the camera's axis, in the
/// colour camera's picture where the library can do that; pixels without depth are unknown. Errors: device
/// for a library that is not installed, cannot be loaded or is of another version, and for no such camera;
/// invalid_input with the library's reason if it does not start.
Result<std::unique_ptr<DepthCameraLink>> open_depth_camera(const DepthCamera& camera);

}  // namespace palpable::sources
