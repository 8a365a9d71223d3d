// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/touch/live_source.hpp"
#include "palpable/sources/depth_camera/depth_camera.hpp"

#include <memory>
#include <string>

namespace palpable::session {

/// A depth camera of this machine; `address` names it in sentences. Errors: as sources::open_depth_camera().
Result<std::unique_ptr<LiveSource>> open_depth_camera_source(const sources::DepthCamera& camera,
                                                             std::string address);

}  // namespace palpable::session
