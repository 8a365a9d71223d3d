// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/contours_recipe.hpp"

#include "palpable/sculpt/contours/junctions.hpp"
#include "palpable/sculpt/relief/relief_from_depth.hpp"
#include "palpable/vision/image/reduced_picture.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

std::string method_name(vision::ContourMethod method) {
  switch (method) {
    case vision::ContourMethod::paper:
      return "contours, paper";
    case vision::ContourMethod::best:
      return "contours, best";
    case vision::ContourMethod::standard:
      break;
  }
  return "contours";
}

/// Junctions of grooves get a rough material with a name, so that fingers and ears find them.
void mark_junctions(models::Scene& scene, const models::BoundaryMap& map,
                    const sculpt::GrooveOptions& grooves) {
  constexpr double kRadius_m = 0.0015;
  const auto in_px = [&map](double metres) { return metres / map.pixel_m(); };
  sculpt::JunctionOptions branches;
  branches.radius_px = std::clamp(static_cast<int>(std::lround(in_px(kRadius_m))), 10, 24);
  const auto line = sculpt::boundary_lines(map);
  const auto junctions = sculpt::find_junctions(line, branches);
  if (junctions.empty()) return;
  constexpr std::uint8_t kJunction = 1;
  scene.labels = sculpt::mark_junctions(junctions, line.width(), line.height(), in_px(0.75 * grooves.width_m),
                                        kJunction);
  scene.materials.resize(2);
  scene.materials[kJunction].name = "junction";
  scene.materials[kJunction].texture = {models::TouchTexture::Kind::bumps, 0.0015, 25e-6, 0.0};
}

}  // namespace

Result<MadeScene> contours_from_picture(Image picture, const ContoursRecipe& recipe, const Work& work) {
  if (const auto valid = check(picture); !valid) return valid.error();
  std::vector<Note> notes;
  if (auto smaller = vision::reduced(picture, recipe.most_pixels)) {
    notes.emplace_back(fmt::format(
        "The picture was reduced from {} x {} to {} x {} pixels, a difference that a finger cannot feel.",
        picture.width, picture.height, smaller->width, smaller->height));
    picture = *std::move(smaller);
  }
  auto found = vision::find_contours(picture, recipe.contours, work);
  if (!found) return found.error();
  auto map = sculpt::boundary_map_from_contours(*found, recipe.map, work);
  if (!map) return map.error();
  auto grooves = sculpt::grooves_from_boundary_map(*map, recipe.grooves);
  if (!grooves) return grooves.error();
  models::Scene scene;
  scene.scene_from_input = sculpt::scene_from_picture(*grooves, picture.width, picture.height);
  scene.source.method = method_name(recipe.contours.method);
  const auto contours = std::make_shared<const models::Contours>(
      models::Contours{std::move(*map), std::make_shared<const models::Relief>(std::move(*grooves))});
  scene.model = contours;
  mark_junctions(scene, contours->boundaries, recipe.grooves);
  scene.texture = rgb8(picture);
  MadeScene made{std::move(scene), std::move(notes)};
  for (const std::string& note : found->notes) warn(made, note);
  if (found->boundary_fraction > 0.0)
    if (const std::string verdict =
            photograph_verdict(vision::photograph_quality(picture), recipe.photograph);
        !verdict.empty())
      warn(made, verdict);
  return made;
}

}  // namespace palpable::recipes
