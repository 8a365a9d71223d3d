// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"
#include "palpable/recipes/video/corrected_model.hpp"

#include <functional>
#include <vector>

namespace palpable::recipes {

/// How the states of a growing model are shown.
struct GrowthOptions {
  /// A state is shown if its error is lower than that of the last one shown by this share, 0 … 1.
  double least_gain = 0.1;
  /// Finest cells of its field along the longest side, 16 … 4096; at most as many as the final field's.
  int resolution = 96;
};
std::vector<Parameter> parameters_of(GrowthOptions& options);

/// Receives a state of the model, to be touched while it is refined further.
using TakeState = std::function<void(MadeScene)>;

/// An observer of corrected_model() that makes a coarse field of each taken step that is clearly better than
/// the last one shown, with a note that says what it is made of; a state whose surface encloses nothing is
/// left out, and so is the first guess from segments. `field`: as of the final model. `frame_numbers`: of the
/// depth maps. Runs on the thread of corrected_model(), which waits. Empty if `take` is.
ModelStepObserver growing_fields(const GrowthOptions& options, FieldRecipe field,
                                 std::vector<int> frame_numbers, TakeState take, const Work& work);

}  // namespace palpable::recipes
