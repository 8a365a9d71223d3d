// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/recipes/relief/relief_recipe.hpp"
#include "palpable/vision/segmentation/ground.hpp"

#include <vector>

namespace palpable::recipes {

/// The input of the search for ground and background: a picture, and the origin of its depth.
struct SeenPicture {
  Raster<Rgb8> picture;
  vision::DisparityOrigin origin = vision::DisparityOrigin::matched;
};

/// Whether the ground or the background is to be found at all.
bool asks_for_regions(const ReliefRecipe& recipe);

/// The disparity with ground and background treated as the recipe says. Labels and materials of the scene
/// mark both (empty if neither was found); notes say how much they cover, or that there is none.
DisparityMap with_regions_treated(const DisparityMap& disparity, const SeenPicture& seen,
                                  const ReliefRecipe& recipe, const Work& work, models::Scene& scene,
                                  std::vector<Note>& notes);

/// The same for depth that was not matched: it is converted to the disparities of a pair of cameras.
/// Unchanged if neither is found; with a flattened ground the result is heights above it, not depth.
void treat_regions(DepthInput& input, const ReliefRecipe& recipe, const Work& work, models::Scene& regions,
                   std::vector<Note>& notes);

}  // namespace palpable::recipes
