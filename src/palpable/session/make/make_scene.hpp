// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/recipes/contours_recipe.hpp"
#include "palpable/recipes/field_recipe.hpp"
#include "palpable/recipes/fused_depth_recipe.hpp"
#include "palpable/recipes/grid_recipe.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/recipes/relief_recipe.hpp"
#include "palpable/session/make/read_input.hpp"

#include <functional>
#include <string>

namespace palpable::session {

/// The kind of scene that is made.
enum class MakeAs {
  /// Contours of one picture, a field of a mesh, points, superquadrics or a level set, else a relief.
  by_input,
  relief,
  contours,
  field,
  grid
};

/// The recipes, one for each kind of scene; the one that fits the input is used.
struct Recipes {
  recipes::StereoRecipe stereo;
  recipes::ReliefRecipe relief;
  recipes::ContoursRecipe contours;
  recipes::FieldRecipe field;
  /// Of several depth maps; their field is stored as `field` says.
  sculpt::FusionOptions fusion;
  recipes::GridRecipe grid;
};

/// What a scene is made from, and how.
struct MakeOptions {
  InputOptions input;
  MakeAs as = MakeAs::by_input;
  Recipes recipes;
  /// Written into the scene's provenance: "palpable 0.1.0".
  std::string made_by;
};

/// From files to a touchable scene: recognises them, reads them and runs the recipe that fits. Long work:
/// reports progress, polls cancel. Errors: invalid_input naming the file, usage for options that do not fit
/// the input, interrupted.
Result<recipes::MadeScene> make_scene(const MakeOptions& options, const Work& work);

/// Receives a scene as soon as it is made.
using TakeScene = std::function<void(recipes::MadeScene)>;

/// The same for a touch that is to begin at once: where no stereo method is fixed, a pair's scene comes first
/// by the fastest method, then by the best one. Errors: as make_scene(); scenes that were made before an
/// error have been delivered.
Result<void> make_scenes(const MakeOptions& options, const TakeScene& take, const Work& work);

}  // namespace palpable::session
