// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/map_recipe.hpp"

#include "palpable/sculpt/relief/relief_from_depth.hpp"
#include "palpable/vision/image/reduced_picture.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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
  map.metres_per_px /= 0.5 * (sx + sy);
  map.width_px = width;
  map.height_px = height;
}

/// "A, B, C and 12 more".
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNamed = 5;
  const std::size_t count = std::min(names.size(), kMostNamed);
  std::string words =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count), ", "));
  if (names.size() > count) words += fmt::format(" and {} more", names.size() - count);
  return words;
}

/// What was joined or left out because a finger could not tell it apart.
std::vector<Note> notes_on(const sculpt::StreetRelief& made, const sculpt::TactileRules& rules,
                           std::size_t pieces) {
  std::vector<Note> notes;
  if (const double hollow = sculpt::hollow_part(made.parts, made.relief.pixel_m(), rules);
      hollow > rules.most_hollow)
    notes.emplace_back(
        fmt::format("{:.0f} % of the plate is hollow where streets ran together: no street is felt there. A "
                    "smaller part of the map, or a larger size, keeps them apart.",
                    100.0 * hollow),
        Reason::map_too_dense);
  const sculpt::StreetSelection& streets = made.streets;
  if (streets.left_out > 0) {
    std::string words = fmt::format(
        "{} of {} pieces of streets are left out: a finger could not tell them from more important ones "
        "beside "
        "them.",
        streets.left_out, pieces);
    if (!streets.left_out_names.empty())
      words += fmt::format(" Nothing is felt of {}.", some_of(streets.left_out_names));
    notes.emplace_back(words + " A smaller part of the map, or a larger size, shows more.",
                       Reason::map_too_dense);
  }
  if (streets.merged > 0)
    notes.emplace_back(fmt::format("{} pieces of second carriageways are felt as one groove with the first.",
                                   streets.merged));
  if (made.buildings.drawn > 0 &&
      (made.buildings.left_out > 0 || made.buildings.parts < made.buildings.drawn))
    notes.emplace_back(
        fmt::format("The {} buildings are felt as {} blocks; {} are too small, or too near to streets.",
                    made.buildings.drawn, made.buildings.parts, made.buildings.left_out));
  if (made.waters.left_out > 0)
    notes.emplace_back(fmt::format("{} of {} areas of water are left out: too small, or too near to streets.",
                                   made.waters.left_out, made.waters.drawn));
  return notes;
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
  for (std::size_t i = 0; i < map.streets.size(); ++i) map.streets[i].felt = made->streets.felt[i];
  auto notes = notes_on(*made, recipe.relief.rules, map.streets.size());
  scene.map = std::make_shared<const StreetMap>(std::move(map));
  MadeScene out{std::move(scene), std::move(notes)};
  if (made->left_out_names > 0)
    out.notes.emplace_back(fmt::format(
        "The names of the {} shortest streets are not spoken: a scene has at most 256 materials. A "
        "part of the map with fewer streets has room for all.",
        made->left_out_names));
  return out;
}

}  // namespace

Result<MadeScene> map_from_picture(Image picture, const MapRecipe& recipe, const Work& work) {
  if (const auto valid = check(picture); !valid) return valid.error();
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
