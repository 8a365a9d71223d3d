// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/relief/treated_pair.hpp"

#include "palpable/recipes/relief/regions.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"
#include "palpable/vision/stereo/result/front_view.hpp"

#include <utility>

namespace palpable::recipes {
namespace {

/// Replaces left picture, disparity and camera by the view from between the cameras.
Result<void> move_to_front_view(vision::StereoPair& pair, DisparityMap& disparity, const Work& work) {
  auto front = vision::front_view(pair, disparity.disparity_px, work);
  if (!front) return front.error();
  pair.left = std::move(front->picture);
  disparity.disparity_px = std::move(front->disparity_px);
  // A camera that is half a baseline to the right sees each point half its disparity farther left; at
  // infinity, half of doffs.
  if (disparity.rig) disparity.rig->left.cx += 0.5 * disparity.rig->doffs_px;
  return {};
}

}  // namespace

Result<TreatedPair> treated_pair(const vision::StereoPair& given, const StereoRecipe& stereo,
                                 const ReliefRecipe& recipe, const Work& work) {
  const vision::StereoMethod method = stereo.method.value_or(default_method());
  auto match = vision::match(given, method, stereo.options, work);
  if (!match) return match.error();
  std::vector<Note> notes(match->notes.begin(), match->notes.end());
  if (method == vision::StereoMethod::fast)
    notes.emplace_back(vision::sentence_of(vision::fit_to_touch(given, *match, work)));
  vision::StereoPair pair = given;
  if (recipe.texture == Texture::front)
    if (const auto moved = move_to_front_view(pair, match->disparity, work); !moved) return moved.error();
  models::Scene regions;
  auto disparity = with_regions_treated(match->disparity, {rgb8(pair.left)}, recipe, work, regions, notes);
  return TreatedPair{std::move(pair.left), std::move(disparity), std::move(regions), std::move(notes),
                     "stereo, " + std::string(vision::name_of(method))};
}

}  // namespace palpable::recipes
