// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/recipes/contours_recipe.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/recipes/map_recipe.hpp"
#include "palpable/recipes/relief/relief_recipe.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"
#include "palpable/recipes/solid/fused_depth_recipe.hpp"
#include "palpable/recipes/solid/grid_recipe.hpp"
#include "palpable/recipes/solid/sheet_recipe.hpp"
#include "palpable/session/make/coarse_field.hpp"
#include "palpable/session/make/quick_video.hpp"
#include "palpable/session/make/read_input.hpp"
#include "palpable/session/make/scene_cache.hpp"

#include <functional>
#include <string>

namespace palpable::session {

/// The kind of scene that is made.
enum class MakeAs {
  /// Chosen by the input: contours for one picture; a field for a mesh, points, superquadrics or a level set;
  /// a map for an extract;
  /// otherwise a relief, also for a mesh that is an open sheet.
  by_input,
  relief,
  contours,
  field,
  grid,
  /// Of a street map's picture, or of an OpenStreetMap extract.
  map
};

/// One recipe for each kind of scene; the one that fits the input is used.
struct Recipes {
  recipes::StereoRecipe stereo;
  recipes::ReliefRecipe relief;
  recipes::ContoursRecipe contours;
  recipes::FieldRecipe field;
  /// For a mesh that is an open sheet or is made into a relief; placed as in `field`.
  sculpt::SheetOptions sheet;
  /// For several depth maps; their field is stored as in `field`.
  sculpt::FusionOptions fusion;
  recipes::GridRecipe grid;
  /// Its field is fused as in `fusion` and stored as in `field`.
  recipes::VideoRecipe video;
  recipes::MapRecipe map;
};

/// The input of a scene and the options for making it.
struct MakeOptions {
  InputOptions input;
  MakeAs as = MakeAs::by_input;
  Recipes recipes;
  /// Used by make_scenes() only.
  CoarseField coarse_field;
  /// Used by make_scenes() only.
  QuickVideo quick_video;
  /// Cache of adaptive fields of meshes; not used if its folder is empty.
  SceneCache cache;
  /// Written into the scene's provenance: "palpable 0.1.0".
  std::string made_by;
};

/// Makes a scene from files: recognises them, reads them and runs the fitting recipe, or takes the scene from
/// the cache. Long work: reports progress, polls cancel. Errors: invalid_input naming the file, usage for
/// options that do not fit the input, interrupted.
Result<recipes::MadeScene> make_scene(const MakeOptions& options, const Work& work);

/// Receives a scene as soon as it is made.
using TakeScene = std::function<void(recipes::MadeScene)>;

/// Makes the scenes for a touch that begins as early as possible. If no stereo method is chosen, a pair's
/// scene is made with the fastest method first, then with the best one. For a large mesh whose field is not
/// cached, a coarse field is delivered first, then the requested one. For a video, that of a quick video is
/// delivered first, unless it fails. Errors: as make_scene(); scenes that
/// were made before an error have been delivered.
Result<void> make_scenes(const MakeOptions& options, const TakeScene& take, const Work& work);

}  // namespace palpable::session
