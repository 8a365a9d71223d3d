// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/sculpt/relief/occupancy_from_depth.hpp"

namespace palpable::recipes {

/// How a relief becomes an occupancy grid.
struct GridRecipe {
  sculpt::OccupancyOptions occupancy;
};

/// The volume under the surface of a scene that is a relief, as a lattice of points (Park & Howard 2012).
/// Long work, any thread. Errors, without a place: usage for a scene of another kind and for options out of
/// range; interrupted.
Result<MadeScene> grid_from_relief(MadeScene made, const GridRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
