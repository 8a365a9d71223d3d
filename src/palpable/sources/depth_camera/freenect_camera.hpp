// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/depth_camera/depth_camera.hpp"

namespace palpable::sources {

/// As open_depth_camera(), by libfreenect 0.5.
Result<std::unique_ptr<DepthCameraLink>> open_freenect_camera(const DepthCamera& camera);

}  // namespace palpable::sources
