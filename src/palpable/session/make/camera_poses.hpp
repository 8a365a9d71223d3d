// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <map>

namespace palpable::session {

/// Camera poses by frame number.
using CameraPoses = std::map<long, Transform<models::InputFrame, CameraFrame>>;

/// Reads the poses of a CSV file with the columns frame, qw, qx, qy, qz, tx, ty, tz (world_from_camera, unit
/// quaternions). Errors: invalid_input, naming the file.
Result<CameraPoses> read_camera_poses(const std::filesystem::path& file);

}  // namespace palpable::session
