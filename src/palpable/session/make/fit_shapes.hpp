// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/relief/relief_recipe.hpp"
#include "palpable/recipes/solid/shapes_recipe.hpp"
#include "palpable/sculpt/superquadric/superquadric_set.hpp"
#include "palpable/session/make/read_input.hpp"

#include <filesystem>
#include <vector>

namespace palpable::session {

/// Input and options for fitting superquadrics.
struct FitShapesOptions {
  InputOptions input;
  /// An 8-bit label picture of the depth map's size: pixels of label 0 are ignored, and one shape never
  /// covers different labels. Empty = none.
  std::filesystem::path labels;
  recipes::StereoRecipe stereo;
  sculpt::ShapeSetOptions shapes;
};

struct FittedInput {
  recipes::FittedShapes fitted;
  std::vector<Note> notes;
};

/// Fits superquadrics to an input: a depth map with its camera (from the calibration, its sidecar or the
/// file), a pair of calibrated cameras, points, or a mesh. Results from cameras are in metres with the origin
/// at the camera, x right, y up, z from the object towards the camera. Points and meshes keep their
/// coordinates. Errors: as read_input(); usage for labels without pixels, and for other inputs; invalid_input
/// with Reason::needs_calibration for depth without a camera.
Result<FittedInput> fit_shapes(const FitShapesOptions& options, const Work& work);

}  // namespace palpable::session
