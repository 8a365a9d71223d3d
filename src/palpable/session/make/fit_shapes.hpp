// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/relief_recipe.hpp"
#include "palpable/recipes/shapes_recipe.hpp"
#include "palpable/sculpt/superquadric/superquadric_set.hpp"
#include "palpable/session/make/read_input.hpp"

#include <filesystem>
#include <vector>

namespace palpable::session {

/// Where shapes are looked for.
struct FitShapesOptions {
  InputOptions input;
  /// An 8-bit picture of the depth map's size: 0 is left out, objects of different labels share no shape.
  /// Empty = none.
  std::filesystem::path labels;
  recipes::StereoRecipe stereo;
  sculpt::ShapeSetOptions shapes;
};

struct FittedInput {
  recipes::FittedShapes fitted;
  std::vector<Note> notes;
};

/// Superquadrics for what the input shows: a depth map with its camera (of the calibration, its sidecar or
/// the file), a pair of calibrated cameras, or points. Seen by a camera they are in metres with the camera in
/// the origin, x right, y up, z towards it; points keep their own coordinates. Errors: as read_input(); usage
/// for labels with points, and for other inputs; invalid_input with Reason::needs_calibration for depth
/// without a camera.
Result<FittedInput> fit_shapes(const FitShapesOptions& options, const Work& work);

}  // namespace palpable::session
