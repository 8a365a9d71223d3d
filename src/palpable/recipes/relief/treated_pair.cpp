// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/relief/treated_pair.hpp"

#include "palpable/recipes/relief/regions.hpp"
#include "palpable/recipes/relief/second_view.hpp"
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

/// Adds the verdict on a pair, always from a match by the fast method, so that it is the same for every
/// method: one note, and a warning of the scene if the pair is not fit.
void add_verdict(const vision::StereoPair& pair, const vision::StereoMatch& fast, const Work& work,
                 models::Scene& regions, std::vector<Note>& notes) {
  const vision::FitToTouch fit = vision::fit_to_touch(pair, fast, work);
  notes.emplace_back(vision::sentence_of(fit));
  if (!fit.fit) regions.warnings.push_back(notes.back().sentence);
}

}  // namespace

Result<TreatedPair> treated_pair(const vision::StereoPair& given, const StereoRecipe& stereo,
                                 const ReliefRecipe& recipe, const Work& work) {
  const vision::StereoMethod method = stereo.method.value_or(default_method());
  auto match = vision::match(given, method, stereo.options, work);
  if (!match) return match.error();
  std::vector<Note> notes(match->notes.begin(), match->notes.end());
  models::Scene regions;
  const Work quiet{work.threads, work.seed, {}, work.cancel};
  if (method == vision::StereoMethod::fast)
    add_verdict(given, *match, quiet, regions, notes);
  else if (const auto fast =
               vision::match_confirmed(given, vision::StereoMethod::fast, stereo.options, quiet))
    add_verdict(given, *fast, quiet, regions, notes);
  if (work.cancelled()) return Work::interrupted();
  vision::StereoPair pair = given;
  // Between cameras that were not beside each other there is no view by half a disparity.
  if (recipe.texture == Texture::front && given.frame)
    notes.emplace_back(
        "The pictures were matched along the movement of the camera: the texture is the left picture.");
  else if (recipe.texture == Texture::front)
    if (const auto moved = move_to_front_view(pair, match->disparity, work); !moved) return moved.error();
  std::shared_ptr<const models::SecondView> second;
  if (recipe.texture == Texture::left && !given.frame && !match->exchanged)
    second = std::make_shared<const models::SecondView>(
        second_view(pair.left, pair.right, match->disparity.disparity_px));
  auto disparity = with_regions_treated(match->disparity, {rgb8(pair.left)}, recipe, work, regions, notes);
  return TreatedPair{std::move(pair.left), std::move(disparity),
                     std::move(second),    std::move(regions),
                     std::move(notes),     "stereo, " + std::string(vision::name_of(method))};
}

}  // namespace palpable::recipes
