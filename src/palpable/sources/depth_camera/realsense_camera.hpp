// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/depth_camera/depth_camera.hpp"

namespace palpable::sources {

/// As open_depth_camera(), by librealsense 2.39 or later.
Result<std::unique_ptr<DepthCameraLink>> open_realsense_camera(const DepthCamera& camera);

}  // namespace palpable::sources
