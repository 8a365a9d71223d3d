// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/superquadric/superquadric_set.hpp"
#include "palpable/session/make/make_scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace palpable::session {

struct FittedShapes {
  sculpt::ShapeSet set;
  /// Points that the input gave.
  std::size_t points = 0;
  std::vector<std::string> notes;
};

/// Superquadrics for what `options.inputs` show: a depth map with its camera (of options.calibration, its
/// sidecar or the file), a pair of calibrated cameras (matched by options.method), or points (PLY). Seen by a
/// camera they stand in metres with the camera in the origin, x right, y up, z towards it; points keep their
/// own coordinates. `labels`: empty, or an 8-bit picture of the depth map's shape: 0 is left out, things of
/// different labels share no shape. Errors: as make_scene(); usage for labels beside points, and for other
/// inputs; invalid_input for depth without a camera.
Result<FittedShapes> fit_shapes(const MakeOptions& options, const std::filesystem::path& labels,
                                const sculpt::ShapeSetOptions& shapes, const Work& work);

}  // namespace palpable::session
