// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <map>
#include <string_view>

namespace palpable::session {

/// Camera poses by frame number.
using CameraPoses = std::map<long, Transform<models::InputFrame, CameraFrame>>;

/// The poses of a CSV text with the columns frame, qw, qx, qy, qz, tx, ty, tz (world_from_camera, unit
/// quaternions). Errors: invalid_input, without a place.
Result<CameraPoses> parse_camera_poses(std::string_view csv);

/// The same of a file. Errors: as read_text_file(); invalid_input, naming the file.
Result<CameraPoses> read_camera_poses(const std::filesystem::path& file);

}  // namespace palpable::session
