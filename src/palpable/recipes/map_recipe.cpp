// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/map_recipe.hpp"

#include "palpable/models/streets/special_place_search.hpp"
#include "palpable/sculpt/relief/relief_from_depth.hpp"
#include "palpable/vision/image/reduced_picture.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
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
  for (MapPlace& place : map.places) {
    move(place.at);
    for (MapPoint& p : place.outline) move(p);
  }
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

/// "is" or "are".
std::string_view verb_for(std::size_t count) { return count == 1 ? "is" : "are"; }

/// What became of the buildings.
std::string buildings_note(std::size_t drawn, std::size_t blocks, std::size_t left_out) {
  const std::string all = drawn == 1 ? "The only building" : fmt::format("The {} buildings", drawn);
  if (blocks == 0)
    return fmt::format("{} {} not felt: too small, or too near to streets.", all, verb_for(drawn));
  std::string words = fmt::format("{} {} felt as {}", all, verb_for(drawn),
                                  blocks == 1 ? std::string("one block") : fmt::format("{} blocks", blocks));
  if (left_out > 0)
    words += fmt::format("; {} {} too small, or too near to streets", left_out, verb_for(left_out));
  return words + ".";
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
        "{} of {} pieces of streets {} left out: a finger could not tell {} from more important ones beside "
        "{}.",
        streets.left_out, pieces, verb_for(streets.left_out), streets.left_out == 1 ? "it" : "them",
        streets.left_out == 1 ? "it" : "them");
    if (!streets.left_out_names.empty())
      words += fmt::format(" Nothing is felt of {}.", some_of(streets.left_out_names));
    notes.emplace_back(words + " A smaller part of the map, or a larger size, shows more.",
                       Reason::map_too_dense);
  }
  if (streets.merged > 0)
    notes.emplace_back(
        fmt::format("{} of second carriageways {} felt as one groove with the first.",
                    streets.merged == 1 ? std::string("One piece") : fmt::format("{} pieces", streets.merged),
                    verb_for(streets.merged)));
  if (made.buildings.drawn > 0 &&
      (made.buildings.left_out > 0 || made.buildings.parts < made.buildings.drawn))
    notes.emplace_back(buildings_note(made.buildings.drawn, made.buildings.parts, made.buildings.left_out));
  if (made.waters.left_out > 0)
    notes.emplace_back(fmt::format("{} of {} areas of water {} left out: too small, or too near to streets.",
                                   made.waters.left_out, made.waters.drawn, verb_for(made.waters.left_out)));
  const auto unfelt_places =
      static_cast<std::size_t>(std::count(made.felt_places.begin(), made.felt_places.end(), false));
  if (unfelt_places > 0)
    notes.emplace_back(fmt::format(
        "{} of {} special places {} not felt: there is no room. What is not felt is named when you "
        "ask what is around.",
        unfelt_places, made.felt_places.size(), verb_for(unfelt_places)));
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
  for (std::size_t i = 0; i < map.places.size(); ++i) map.places[i].felt = made->felt_places[i];
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

/// The pixels of a scene's picture that a view shows.
Raster<Rgb8> part_of_picture(const Raster<Rgb8>& picture, const models::MapView& view, const StreetMap& map) {
  const double sx = static_cast<double>(picture.width()) / map.width_px;
  const double sy = static_cast<double>(picture.height()) / map.height_px;
  Raster<Rgb8> part(std::max(1, static_cast<int>(picture.width() / view.zoom)),
                    std::max(1, static_cast<int>(picture.height() / view.zoom)));
  const int left = static_cast<int>(view.corner.x * sx), top = static_cast<int>(view.corner.y * sy);
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x)
      part(x, y) = picture(std::min(picture.width() - 1, left + x), std::min(picture.height() - 1, top + y));
  return part;
}

/// The same way on the enlarged plate.
std::shared_ptr<const models::RouteGuide> guide_in_part(models::RouteGuide guide, const models::MapView& view,
                                                        const StreetMap& map, Vec3 size_m) {
  // The plate's place 0, 0 is the middle of the map.
  const double m_per_px = size_m.x / map.width_px;
  const double left_m = view.corner.x * m_per_px - 0.5 * size_m.x,
               top_m = 0.5 * size_m.y - view.corner.y * m_per_px;
  for (auto& place : guide.line_m)
    place = {(place[0] - left_m) * view.zoom - 0.5 * size_m.x,
             0.5 * size_m.y - (top_m - place[1]) * view.zoom};
  return std::make_shared<const models::RouteGuide>(std::move(guide));
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
  models::add_special_places(found->map, recipe.places);
  auto made = scene_of(std::move(found->map), recipe, "street map");
  if (!made) return made;
  made->scene.texture = rgb8(picture);
  made->notes.insert(made->notes.begin(), notes.begin(), notes.end());
  return made;
}

Result<MadeScene> part_of_map(const models::Scene& whole, const models::MapView& view,
                              const MapRecipe& recipe) {
  constexpr double kMostZoom = 100.0;
  if (!(view.zoom >= 1.0 && view.zoom <= kMostZoom))
    return Error{ErrorCode::usage, "a map is enlarged 1 to 100 times", {}};
  StreetMap part = models::part_of_map(*whole.map, view);
  if (part.streets.empty()) return invalid_input("has no streets in this part");
  MapRecipe same_size = recipe;
  const Vec3 size = models::size_m(whole);
  same_size.relief.width_m = size.x;
  same_size.relief.height_m = size.y;
  auto made = scene_of(std::move(part), same_size, whole.source.method.c_str());
  if (!made) return made;
  models::Scene& scene = made->scene;
  scene.title = whole.title;
  scene.description = whole.description;
  scene.source = whole.source;
  for (models::Material& material : scene.materials)
    for (const models::Material& known : whole.materials)
      if (known.name == material.name) material = known;
  if (!whole.texture.empty()) scene.texture = part_of_picture(whole.texture, view, *whole.map);
  if (whole.guide != nullptr) scene.guide = guide_in_part(*whole.guide, view, *whole.map, size);
  return made;
}

Result<MadeScene> map_from_extract(StreetMap map, const MapRecipe& recipe) {
  return scene_of(std::move(map), recipe, "map extract");
}

}  // namespace palpable::recipes
