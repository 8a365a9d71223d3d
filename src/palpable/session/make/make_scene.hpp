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
#include "palpable/recipes/sheet_recipe.hpp"
#include "palpable/session/make/read_input.hpp"
#include "palpable/session/make/scene_cache.hpp"

#include <functional>
#include <string>

namespace palpable::session {

/// The kind of scene that is made.
enum class MakeAs {
  /// Contours of one picture, a field of a mesh, points, superquadrics or a level set, else a relief; a
  /// relief
  /// also of a mesh that is an open sheet.
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
  /// Of a mesh that is an open sheet, or that becomes a relief; placed as `field` says.
  sculpt::SheetOptions sheet;
  /// Of several depth maps; their field is stored as `field` says.
  sculpt::FusionOptions fusion;
  recipes::GridRecipe grid;
  /// Its field is fused and stored as `fusion` and `field` say.
  recipes::VideoRecipe video;
};

/// The field that a touch of a mesh begins with while the one that is asked for is made. Chosen so that a
/// mesh of 100 000 triangles is touched within 5 s on two cores (docs/history/2026-11-22-scenes.md).
struct CoarseField {
  /// Finest cells along its longest side, 16 ... 512; 0 = no coarse field. Only where the field that is asked
  /// for has at least twice as many.
  int resolution = 96;
  /// Its error bound, metres, where the other one is not coarser.
  double max_error_m = 0.0001;
  /// Meshes of fewer triangles are made at once.
  int least_triangles = 5000;
};

/// What a scene is made from, and how.
struct MakeOptions {
  InputOptions input;
  MakeAs as = MakeAs::by_input;
  Recipes recipes;
  /// Of make_scenes().
  CoarseField coarse_field;
  /// Where adaptive fields of meshes are stored; none unless its folder is given.
  SceneCache cache;
  /// Written into the scene's provenance: "palpable 0.1.0".
  std::string made_by;
};

/// From files to a touchable scene: recognises them, reads them and runs the recipe that fits, or takes
/// the scene from the cache. Long work: reports progress, polls cancel. Errors: invalid_input naming the
/// file, usage for options that do not fit the input, interrupted.
Result<recipes::MadeScene> make_scene(const MakeOptions& options, const Work& work);

/// Receives a scene as soon as it is made.
using TakeScene = std::function<void(recipes::MadeScene)>;

/// The same for a touch that is to begin at once: where no stereo method is fixed, a pair's scene comes first
/// by the fastest method, then by the best one; a large mesh's field that is not cached comes coarse first,
/// then as asked for. Errors: as make_scene(); scenes that were made before an error have been delivered.
Result<void> make_scenes(const MakeOptions& options, const TakeScene& take, const Work& work);

}  // namespace palpable::session
