// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/relief/relief_recipe.hpp"

#include <memory>
#include <string>
#include <vector>

namespace palpable::recipes {

/// A pair's disparity after matching, with its ground and background treated as in a relief recipe.
struct TreatedPair {
  /// The picture of the view to which the disparity belongs.
  Image picture;
  DisparityMap disparity;
  /// The other picture as the right eye's view; null if it is none: the cameras were not beside each other,
  /// or exchanged, or `picture` is that from between them.
  std::shared_ptr<const models::SecondView> second_view;
  /// Labels and materials of ground and background, empty where neither was found; and a warning if the pair
  /// is not fit to touch.
  models::Scene regions;
  std::vector<Note> notes;
  /// For models::Scene::source.
  std::string method;
};

/// Long work: reports progress, polls cancel. Any thread. Errors, without a place: as vision::match();
/// interrupted.
Result<TreatedPair> treated_pair(const vision::StereoPair& given, const StereoRecipe& stereo,
                                 const ReliefRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
