// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/sculpt/superquadric/superquadric_residuals.hpp"

#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// The lines of sight through the outline of `label` in a label picture: one between each pair of
/// neighbouring pixels of which exactly one has the label; the picture's border is omitted.
/// `scene_from_camera` is the camera's pose.
std::vector<LineOfSight> outline_of(const Raster<std::uint8_t>& labels, std::uint8_t label,
                                    const Pinhole& camera,
                                    const Transform<SceneFrame, CameraFrame>& scene_from_camera);

}  // namespace palpable::sculpt
