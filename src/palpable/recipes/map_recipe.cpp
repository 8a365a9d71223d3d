// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/map_recipe.hpp"

#include "palpable/sculpt/relief/relief_from_depth.hpp"
#include "palpable/vision/image/reduced_picture.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

/// From pixels of the reduced picture to those of the original one.
void enlarge(StreetMap& map, int width, int height) {
  const double sx = static_cast<double>(width) / map.width_px;
  const double sy = static_cast<double>(height) / map.height_px;
  const auto move = [sx, sy](MapPoint& p) { p = {(p.x + 0.5) * sx - 0.5, (p.y + 0.5) * sy - 0.5}; };
  for (MapStreet& street : map.streets) {
    street.width_px *= 0.5 * (sx + sy);
    for (MapPoint& p : street.points) move(p);
  }
  for (MapJunction& junction : map.junctions) move(junction.at);
  for (MapArea& area : map.areas)
    for (MapPoint& p : area.outline) move(p);
  for (MapLabel& label : map.labels)
    for (MapPoint& p : label.box) move(p);
  map.width_px = width;
  map.height_px = height;
}

Result<MadeScene> scene_of(StreetMap map, const MapRecipe& recipe, const char* method) {
  auto made = sculpt::relief_from_street_map(map, recipe.relief);
  if (!made) return made.error();
  models::Scene scene;
  scene.scene_from_input = sculpt::scene_from_picture(made->relief, map.width_px, map.height_px);
  scene.model = std::make_shared<const models::Relief>(std::move(made->relief));
  scene.labels = std::move(made->labels);
  scene.materials = std::move(made->materials);
  scene.source.method = method;
  scene.map = std::make_shared<const StreetMap>(std::move(map));
  MadeScene out{std::move(scene), {}};
  if (made->left_out_names > 0)
    out.notes.emplace_back(fmt::format(
        "The names of the {} shortest streets are not spoken: a scene has at most 256 materials. A "
        "part of the map with fewer streets has room for all.",
        made->left_out_names));
  return out;
}

}  // namespace

Result<MadeScene> map_from_picture(Image picture, const MapRecipe& recipe, const Work& work) {
  std::vector<Note> notes;
  const int width = picture.width;
  const int height = picture.height;
  if (auto smaller = vision::reduced(picture, recipe.most_pixels)) {
    notes.emplace_back(fmt::format("The picture was reduced from {} x {} to {} x {} pixels.", width, height,
                                   smaller->width, smaller->height));
    picture = *std::move(smaller);
  }
  auto found = vision::street_map_from_picture(picture, recipe.streets, work);
  if (!found) return found.error();
  notes.insert(notes.end(), found->notes.begin(), found->notes.end());
  enlarge(found->map, width, height);
  auto made = scene_of(std::move(found->map), recipe, "street map");
  if (!made) return made;
  made->scene.texture = rgb8(picture);
  made->notes.insert(made->notes.begin(), notes.begin(), notes.end());
  return made;
}

Result<MadeScene> map_from_extract(StreetMap map, const MapRecipe& recipe) {
  return scene_of(std::move(map), recipe, "map extract");
}

}  // namespace palpable::recipes
