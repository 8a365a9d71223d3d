// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/relief/relief_recipe.hpp"

#include "palpable/recipes/relief/regions.hpp"
#include "palpable/recipes/relief/treated_pair.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

models::Scene relief_scene(models::Relief relief, int width, int height, std::string method) {
  models::Scene scene;
  scene.scene_from_input = sculpt::scene_from_picture(relief, width, height);
  scene.model = std::make_shared<const models::Relief>(std::move(relief));
  scene.source.method = std::move(method);
  return scene;
}

/// Warns if a nearer place is too often not higher than a farther one. Heights above a flattened ground are
/// no depths, but their order is meant just as well.
void warn_of_order(MadeScene& made, const sculpt::DepthOrders& orders, const ReliefRecipe& recipe) {
  const bool is_local = orders.nearby.kept < orders.anywhere.kept;
  const sculpt::DepthOrder& order = is_local ? orders.nearby : orders.anywhere;
  constexpr std::size_t kFewestPairs = 100;
  if (order.kept >= recipe.least_kept_order || order.pairs < kFewestPairs) return;
  const bool engraved = recipe.relief.sense == sculpt::Sense::engrave;
  const auto percent = [](double share) { return std::lround(100.0 * share); };
  const bool is_linear = recipe.relief.detail == sculpt::DetailOperator::linear;
  warn(made, fmt::format("Heights are out of proportion: of two places{} at different depths, the nearer one "
                         "is {} in only {} of 100 cases, and {} in {}.{}",
                         is_local ? " beside each other" : "", engraved ? "deeper" : "higher",
                         percent(order.kept), engraved ? "higher" : "lower", percent(order.inverted),
                         is_linear ? "" : " The linear detail operator keeps the order of depth."));
}

Result<void> remove_noise(DepthMap& depth, const ReliefRecipe& recipe, const Work& work,
                          std::vector<Note>& notes) {
  work.report(0.1, "smoothing the depth camera's noise");
  auto smooth = vision::smooth_depth(depth.depth_m, recipe.depth_camera, work);
  if (!smooth) return smooth.error();
  if (smooth->level > 0.0)
    notes.emplace_back(fmt::format(
        "The depth has a depth camera's noise, about {:.1f} mm at 2 m, which was smoothed; {} readings on "
        "no surface (flying pixels, outliers) were moved to the surfaces beside them.",
        1e3 * smooth->level * static_cast<double>(recipe.depth_camera.noise.deviation_m(2.0F)),
        smooth->flying));
  depth.depth_m = std::move(smooth->depth_m);
  return {};
}

bool is_available(vision::StereoMethod method) {
  const auto methods = vision::available_stereo_methods();
  return std::find(methods.begin(), methods.end(), method) != methods.end();
}

}  // namespace

Result<void> check(const ReliefRecipe& recipe) {
  if (auto valid = check_ranges(recipe.ground_options); !valid) return valid;
  if (auto valid = check_ranges(recipe.depth_camera); !valid) return valid;
  if (!(recipe.least_kept_order >= 0.0 && recipe.least_kept_order <= 1.0))
    return Error{ErrorCode::usage, "the least share of pairs in order must be 0 to 1", {}};
  return check_ranges(recipe.background_options);
}

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

Result<MadeScene> relief_from_pair(const vision::StereoPair& pair, const StereoRecipe& stereo,
                                   const ReliefRecipe& recipe, const Work& work) {
  if (const auto valid = check(recipe); !valid) return valid.error();
  auto treated = treated_pair(pair, stereo, recipe, work);
  if (!treated) return treated.error();
  sculpt::DepthOrders orders;
  auto relief = sculpt::relief_from_disparity(treated->disparity, recipe.relief, work, &orders);
  if (!relief) return relief.error();
  const Image& picture = treated->picture;
  models::Scene scene =
      relief_scene(std::move(*relief), picture.width, picture.height, std::move(treated->method));
  scene.materials = std::move(treated->regions.materials);
  scene.labels = std::move(treated->regions.labels);
  scene.warnings = std::move(treated->regions.warnings);
  if (recipe.texture != Texture::none) scene.texture = rgb8(picture);
  scene.second_view = std::move(treated->second_view);
  MadeScene made{std::move(scene), std::move(treated->notes)};
  warn_of_order(made, orders, recipe);
  return made;
}

Result<MadeScene> relief_from_depth(DepthInput input, const ReliefRecipe& recipe, const Work& work) {
  if (const auto valid = check(recipe); !valid) return valid.error();
  if (input.colour)
    if (const auto valid = palpable::check(*input.colour); !valid) return valid.error();
  models::Scene regions;
  std::vector<Note> notes;
  if (auto* measured = std::get_if<DepthMap>(&input.depth))
    if (const auto smoothed = remove_noise(*measured, recipe, work, notes); !smoothed)
      return smoothed.error();
  treat_regions(input, recipe, work, regions, notes);
  const auto* metres = std::get_if<DepthMap>(&input.depth);
  const auto* disparity = std::get_if<DisparityMap>(&input.depth);
  sculpt::DepthOrders orders;
  auto relief = metres != nullptr ? sculpt::relief_from_depth(*metres, recipe.relief, work, &orders)
                                  : sculpt::relief_from_disparity(*disparity, recipe.relief, work, &orders);
  if (!relief) return relief.error();
  const Raster<float>& values = metres != nullptr ? metres->depth_m : disparity->disparity_px;
  models::Scene scene = relief_scene(std::move(*relief), values.width(), values.height(), "depth map");
  if (!regions.labels.empty()) {
    scene.materials = std::move(regions.materials);
    scene.labels = std::move(regions.labels);
  }
  if (input.colour && recipe.texture != Texture::none) scene.texture = rgb8(*input.colour);
  MadeScene made{std::move(scene), std::move(notes)};
  warn_of_order(made, orders, recipe);
  return made;
}

}  // namespace palpable::recipes
