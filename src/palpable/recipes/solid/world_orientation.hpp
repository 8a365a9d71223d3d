// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/models/scene/scene.hpp"

#include <array>
#include <span>

namespace palpable::recipes {

/// Row-major rotation by right angles from the world of the camera poses to the scene, so that on average
/// the cameras look away from the user (along -z) and their pictures' upward direction is y. The identity
/// if they do already. Poses: world from camera, camera x right, y down, z forward.
std::array<double, 9> scene_rotation_for(
    std::span<const Transform<models::InputFrame, CameraFrame>> world_from_cameras);

}  // namespace palpable::recipes
