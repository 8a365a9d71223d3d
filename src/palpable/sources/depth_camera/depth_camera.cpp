// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth_camera/depth_camera.hpp"

#include "palpable/sources/depth_camera/freenect_camera.hpp"
#include "palpable/sources/depth_camera/openni_camera.hpp"
#include "palpable/sources/depth_camera/realsense_camera.hpp"

namespace palpable::sources {

const char* library_name(DepthCamera::Kind kind) {
  switch (kind) {
    case DepthCamera::Kind::openni:
      return "OpenNI";
    case DepthCamera::Kind::freenect:
      return "libfreenect";
    case DepthCamera::Kind::realsense:
      return "librealsense";
  }
  return "";
}

Result<std::unique_ptr<DepthCameraLink>> open_depth_camera(const DepthCamera& camera) {
  switch (camera.kind) {
    case DepthCamera::Kind::openni:
      break;
    case DepthCamera::Kind::freenect:
      return open_freenect_camera(camera);
    case DepthCamera::Kind::realsense:
      return open_realsense_camera(camera);
  }
  return open_openni_camera(camera);
}

}  // namespace palpable::sources
