// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/recipes/relief/relief_recipe.hpp"
#include "palpable/sculpt/relief/occupancy_from_depth.hpp"

namespace palpable::recipes {

/// How an occupancy grid is filled.
enum class GridFilling {
  /// Under the relief.
  under_relief,
  /// Away from the camera, behind the points that a pair's camera sees, at their positions in space; ground
  /// and background may be removed first (Park & Howard 2012, 4 and 5).
  from_camera
};

/// How an occupancy grid is made.
struct GridRecipe {
  sculpt::OccupancyOptions occupancy;
  GridFilling filling = GridFilling::under_relief;
  /// The box that the grid is fitted into with its own proportions, if it is filled from the camera.
  Vec3 size_m{0.10, 0.10, 0.05};
};

/// The volume under the surface of a scene that is a relief, as a lattice of points (Park & Howard 2012).
/// Long work, any thread. Errors, without a place: usage for a scene of another kind and for options out of
/// range; interrupted.
Result<MadeScene> grid_from_relief(MadeScene made, const GridRecipe& recipe, const Work& work);

/// The volume behind the surface that a matched pair's left camera sees (GridFilling::from_camera).
/// `disparity`: NaN = not filled. If its rig is unknown, a camera with a width of view equal to the distance
/// is assumed, and a note says so. Long work, any thread. Errors, without a place: invalid_input if no
/// disparity is known; as grid_from_relief().
Result<MadeScene> grid_from_disparity(DisparityMap disparity, const GridRecipe& recipe, const Work& work);

/// The same from the pair itself: matched, and without its ground and background where `regions` removes
/// them. Errors: also as vision::match().
Result<MadeScene> grid_from_pair(const vision::StereoPair& pair, const StereoRecipe& stereo,
                                 const ReliefRecipe& regions, const GridRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
