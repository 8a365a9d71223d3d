// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/sculpt/relief/relief_from_sheet.hpp"
#include "palpable/sculpt/triangles/placement.hpp"

namespace palpable::recipes {

/// How a mesh becomes a relief of one of its sides.
struct SheetRecipe {
  /// Default size: 100 x 100 mm and 15 mm high, or its own if the visible side suits a hand. The visible side
  /// fills it; heights are divided where they are more. `lay` flat:
  /// seen from above; upright: from the front; automatic: the side that an open sheet faces, and other
  /// meshes as sculpt::placement_of() lays them.
  sculpt::PlacementOptions placement;
  sculpt::SheetOptions sheet;
};

/// The relief of the part of a mesh that is visible from one side. Long work: all threads, polls cancel.
/// Errors have no place: invalid_input for a mesh without extent, usage for options out of range,
/// interrupted.
Result<MadeScene> relief_from_mesh(Mesh mesh, const SheetRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
