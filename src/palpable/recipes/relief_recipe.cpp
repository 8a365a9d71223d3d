// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/relief_recipe.hpp"

#include "palpable/recipes/regions.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"
#include "palpable/vision/stereo/result/front_view.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace palpable::recipes {
namespace {

models::Scene relief_scene(models::Relief relief, int width, int height, std::string method) {
  models::Scene scene;
  scene.scene_from_input = sculpt::scene_from_picture(relief, width, height);
  scene.model = std::make_shared<const models::Relief>(std::move(relief));
  scene.source.method = std::move(method);
  return scene;
}

/// Replaces left picture, disparity and camera by the view from between the cameras.
Result<void> move_to_front_view(vision::StereoPair& pair, DisparityMap& disparity, const Work& work) {
  auto front = vision::front_view(pair, disparity.disparity_px, work);
  if (!front) return front.error();
  pair.left = std::move(front->picture);
  disparity.disparity_px = std::move(front->disparity_px);
  // Half a baseline to the right everything lies half its disparity to the left; at infinity, half of doffs.
  if (disparity.rig) disparity.rig->left.cx += 0.5 * disparity.rig->doffs_px;
  return {};
}

bool is_available(vision::StereoMethod method) {
  const auto methods = vision::available_stereo_methods();
  return std::find(methods.begin(), methods.end(), method) != methods.end();
}

}  // namespace

vision::StereoMethod default_method() {
  return is_available(vision::StereoMethod::best) ? vision::StereoMethod::best
                                                  : vision::StereoMethod::scanline;
}

std::vector<vision::StereoMethod> progressive_methods(const StereoRecipe& stereo) {
  if (stereo.method) return {*stereo.method};
  const vision::StereoMethod last = default_method();
  const vision::StereoMethod first =
      is_available(vision::StereoMethod::fast) ? vision::StereoMethod::fast : vision::StereoMethod::scanline;
  return first == last ? std::vector{last} : std::vector{first, last};
}

Result<MadeScene> relief_from_pair(const vision::StereoPair& given, const StereoRecipe& stereo,
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
  const auto treated =
      with_regions_treated(match->disparity, {rgb8(pair.left)}, recipe, work, regions, notes);
  auto relief = sculpt::relief_from_disparity(treated, recipe.relief, work);
  if (!relief) return relief.error();
  models::Scene scene = relief_scene(std::move(*relief), pair.left.width, pair.left.height,
                                     "stereo, " + std::string(vision::name_of(method)));
  scene.materials = std::move(regions.materials);
  scene.labels = std::move(regions.labels);
  if (recipe.texture != Texture::none) scene.texture = rgb8(pair.left);
  return MadeScene{std::move(scene), std::move(notes)};
}

Result<MadeScene> relief_from_depth(DepthInput input, const ReliefRecipe& recipe, const Work& work) {
  models::Scene regions;
  std::vector<Note> notes;
  treat_regions(input, recipe, work, regions, notes);
  const auto* metres = std::get_if<DepthMap>(&input.depth);
  const auto* disparity = std::get_if<DisparityMap>(&input.depth);
  auto relief = metres != nullptr ? sculpt::relief_from_depth(*metres, recipe.relief, work)
                                  : sculpt::relief_from_disparity(*disparity, recipe.relief, work);
  if (!relief) return relief.error();
  const Raster<float>& values = metres != nullptr ? metres->depth_m : disparity->disparity_px;
  models::Scene scene = relief_scene(std::move(*relief), values.width(), values.height(), "depth map");
  if (!regions.labels.empty()) {
    scene.materials = std::move(regions.materials);
    scene.labels = std::move(regions.labels);
  }
  if (input.colour && recipe.texture != Texture::none) scene.texture = rgb8(*input.colour);
  return MadeScene{std::move(scene), std::move(notes)};
}

}  // namespace palpable::recipes
