// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/relief/regions.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/segmentation/background.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

/// Materials of the regions of a scene; they feel alike, but have names.
enum Region : std::uint8_t { kObjects, kGround, kBackground };

void mark(models::Scene& scene, const Raster<std::uint8_t>& mask, Region region) {
  if (scene.labels.empty()) {
    scene.labels = Raster<std::uint8_t>(mask.width(), mask.height(), kObjects);
    scene.materials.resize(3);
    scene.materials[kGround].name = "ground";
    scene.materials[kBackground].name = "background";
  }
  for (std::size_t i = 0; i < mask.count(); ++i)
    if (mask.values()[i] != 0) scene.labels.values()[i] = region;
}

/// The ground, if the recipe needs it, with a note.
std::optional<vision::Ground> ground_of(const DisparityMap& disparity, const SeenPicture& seen,
                                        const ReliefRecipe& recipe, const Work& work,
                                        std::vector<Note>& notes) {
  const bool wanted = recipe.ground != vision::GroundTreatment::keep;
  if (!asks_for_regions(recipe)) return std::nullopt;
  work.report(0.9, "finding the ground");
  auto ground =
      vision::find_ground(seen.picture, disparity.disparity_px, work, seen.origin, recipe.ground_options);
  // A plane that covers the whole picture has no objects on it and must not include the background.
  constexpr double kEverywhere = 0.95;
  if (ground && !wanted && ground->share > kEverywhere) return std::nullopt;
  if (ground)
    notes.emplace_back(fmt::format("The ground covers {:.0f} % of the picture{}.", 100.0 * ground->share,
                                   seen.origin == vision::DisparityOrigin::matched
                                       ? fmt::format(", {:.2f} px from a plane", ground->rms_px)
                                       : std::string()));
  else if (wanted)
    notes.emplace_back("No ground was found in this picture: the relief keeps it as it is.",
                       Reason::no_ground_found);
  return ground;
}

/// The background, if it is to be removed, with a note.
std::optional<vision::Background> background_of(const DisparityMap& disparity,
                                                const std::optional<vision::Ground>& ground,
                                                const SeenPicture& seen, const ReliefRecipe& recipe,
                                                const Work& work, std::vector<Note>& notes) {
  if (recipe.background == BackgroundTreatment::keep) return std::nullopt;
  work.report(0.92, "finding the background");
  auto background = vision::find_background(seen.picture, disparity.disparity_px, ground ? &*ground : nullptr,
                                            work, recipe.background_options);
  if (background)
    notes.emplace_back(
        fmt::format("The background covers {:.0f} % of the picture.", 100.0 * background->share));
  else
    notes.emplace_back(
        ground ? "There is no background to remove: everything stands on the ground."
               : "There is no background to remove: no part of the picture is clearly behind the rest.");
  return background;
}

/// Depth as disparity, so that the limits in pixels of the search for ground and background hold: the
/// inverse of depth, as two cameras side by side would see it. The nearest depth, without the nearest half
/// percent as outliers, gets kNearest_px. A map with a known rig does not change.
DisparityMap parallax_of(const std::variant<DepthMap, DisparityMap>& depth) {
  constexpr double kNearest_px = 256.0, kWild = 0.005;
  const auto* metres = std::get_if<DepthMap>(&depth);
  DisparityMap map = metres != nullptr ? DisparityMap{metres->depth_m, {}} : std::get<DisparityMap>(depth);
  if (map.rig) return map;
  std::vector<float> known;
  for (float& value : map.disparity_px.values()) {
    if (metres != nullptr) value = 1.0F / value;
    if (std::isfinite(value)) known.push_back(value);
  }
  if (known.empty()) return map;
  const double scale = kNearest_px / double{quantile_of(known, 1.0 - kWild)};
  for (float& value : map.disparity_px.values()) value *= static_cast<float>(scale);
  if (metres == nullptr) return map;
  const int width = metres->depth_m.width(), height = metres->depth_m.height();
  const Pinhole any{1.0 * width, 1.0 * width, 0.5 * (width - 1), 0.5 * (height - 1), width, height};
  const Pinhole camera = metres->camera.value_or(any);
  map.rig = StereoRig{camera, scale / camera.fx, 0.0};
  return map;
}

/// Parallax as a grey picture, for depth without colour.
Raster<Rgb8> grey_of(const DisparityMap& parallax) {
  Raster<Rgb8> out(parallax.disparity_px.width(), parallax.disparity_px.height());
  for (std::size_t i = 0; i < out.count(); ++i) {
    const float d = parallax.disparity_px.values()[i];
    const auto level =
        static_cast<std::uint8_t>(std::isfinite(d) ? std::clamp(2.0F * d, 0.0F, 255.0F) : 0.0F);
    out.values()[i] = {level, level, level};
  }
  return out;
}

}  // namespace

bool asks_for_regions(const ReliefRecipe& recipe) {
  return recipe.ground != vision::GroundTreatment::keep || recipe.background != BackgroundTreatment::keep;
}

DisparityMap with_regions_treated(const DisparityMap& disparity, const SeenPicture& seen,
                                  const ReliefRecipe& recipe, const Work& work, models::Scene& scene,
                                  std::vector<Note>& notes) {
  const auto ground = ground_of(disparity, seen, recipe, work, notes);
  const auto background = background_of(disparity, ground, seen, recipe, work, notes);
  if (background) mark(scene, background->mask, kBackground);
  if (ground) mark(scene, ground->mask, kGround);
  DisparityMap treated = disparity;
  if (ground && (!background || recipe.ground == vision::GroundTreatment::flatten))
    treated = vision::treat_ground(disparity, *ground, recipe.ground);
  if (!background) return treated;
  Raster<std::uint8_t> goes = background->mask;
  if (ground && recipe.ground == vision::GroundTreatment::remove)
    for (std::size_t i = 0; i < goes.count(); ++i) goes.values()[i] |= ground->mask.values()[i];
  return vision::lowered(treated, goes);
}

void treat_regions(DepthInput& input, const ReliefRecipe& recipe, const Work& work, models::Scene& regions,
                   std::vector<Note>& notes) {
  if (!asks_for_regions(recipe)) return;
  const DisparityMap parallax = parallax_of(input.depth);
  const SeenPicture seen{input.colour ? rgb8(*input.colour) : grey_of(parallax),
                         vision::DisparityOrigin::measured};
  DisparityMap treated = with_regions_treated(parallax, seen, recipe, work, regions, notes);
  if (regions.labels.empty()) return;
  const auto* metres = std::get_if<DepthMap>(&input.depth);
  // Heights above the ground are not depths and have no camera.
  if (metres == nullptr || !treated.rig) {
    input.depth = std::move(treated);
    return;
  }
  DepthMap depth = *depth_from_disparity(treated);
  depth.camera = metres->camera;
  input.depth = std::move(depth);
}

}  // namespace palpable::recipes
