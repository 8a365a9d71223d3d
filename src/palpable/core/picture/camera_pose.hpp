// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

namespace palpable {

/// The pose of a camera at a position in a world whose z axis points up: it looks along `heading_rad`
/// (counter-clockwise from the world's x axis), tilted down by `down_rad`, its x axis level.
Transform<WorldFrame, CameraFrame> camera_pose(Point<WorldFrame> position, double heading_rad,
                                               double down_rad);

}  // namespace palpable
