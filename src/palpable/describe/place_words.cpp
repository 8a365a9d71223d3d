// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/place_words.hpp"

#include "palpable/describe/contour_lines.hpp"
#include "palpable/describe/found_places.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/map_route_words.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_guide.hpp"
#include "palpable/describe/solid_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

constexpr double kHere_m = 0.0005;
// Lines farther away than this are not mentioned.
constexpr double kLineReach_m = 0.015;

const models::BoundaryMap* boundaries_of(const models::Scene& scene) {
  const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&scene.model);
  return contours != nullptr ? &(*contours)->boundaries : nullptr;
}

/// For contours: on a line, with its direction, or the offset to the nearest line.
std::string line_at(const models::BoundaryMap& map, Place place) {
  const auto line = nearest_line(map, place, kLineReach_m);
  if (!line) return tr("no line near here");
  if (std::hypot(line->dx_m, line->dy_m) <= kOnLine_m)
    return phrase("on the line, {}", line_words(line->angle_rad));
  return phrase("beside the line, {}", offset_words(line->dx_m, line->dy_m));
}

/// Of a solid, heights are above its base, or from its back if it stands upright.
double base_of(const models::Scene& scene) {
  if (!models::is_field(scene.model)) return 0.0;
  return models::centre_m(scene).z - 0.5 * models::size_m(scene).z;
}

/// Whether a scene is a solid that is not at this place.
bool is_beside_solid(const models::Scene& scene, Place place) {
  if (!models::is_field(scene.model)) return false;
  const double height_m = models::relief_of(scene)->sample(place.x_m, place.y_m).z_m - base_of(scene);
  return !is_of_solid(height_m, models::size_m(scene).z);
}

/// Height and slope. Not for a place beside a solid.
std::string surface_at(const models::Scene& scene, double height_factor, Place place) {
  const models::HeightSample at = models::relief_of(scene)->sample(place.x_m, place.y_m);
  return fmt::format("{}, {}", spoken_length(height_factor * (at.z_m - base_of(scene))),
                     slope_words(height_factor * at.dzdx, height_factor * at.dzdy));
}

/// Beside a solid: where it is.
std::string beside_words(const models::Scene& scene, Place place) {
  const auto surface = nearest_surface(scene, place);
  if (!surface) return tr("nothing here");
  return phrase("nothing here, the surface is {}",
                offset_words(surface->x_m - place.x_m, surface->y_m - place.y_m));
}

/// The sentence of a name, after a blank; empty without any.
std::string sentence_after(const models::PlaceName& name) {
  if (name.sentence.empty()) return {};
  const bool ends = name.sentence.find_last_of(".!?") + 1 == name.sentence.size();
  return fmt::format(" {}{}", name.sentence, ends ? "" : ".");
}

/// All names that cover a place, those that persons gave with their sentences, each after a blank. Of a map
/// only these: its own are in other words.
std::string names_here(const models::Scene& scene, Place place, const PlaceGuide& guide) {
  std::string words = is_at_route_end(scene, place) ? fmt::format(" {}.", capitalised(tr(kRouteEnd))) : "";
  std::vector<std::string> said;
  for (const std::size_t index : guide.here(place)) {
    const NamedPlace& named = guide.places()[index];
    if (scene.map != nullptr && !named.written) continue;
    if (std::find(said.begin(), said.end(), named.name.name) != said.end()) continue;
    said.push_back(named.name.name);
    words += fmt::format(" {}.{}", capitalised(named.name.name), sentence_after(named.name));
  }
  return words;
}

/// How the coordinate towards the user is called.
const char* height_name(const models::Scene& scene) {
  return models::is_upright_solid(scene) ? tr("towards you") : tr("height");
}

/// Relative to the middle of the scene, which for a solid may be beside the origin.
Place from_centre(const models::Scene& scene, Place place) {
  const Vec3 centre = models::centre_m(scene);
  return {place.x_m - centre.x, place.y_m - centre.y};
}

std::string where(const models::Scene& scene, Place place) {
  const Vec3 size = models::size_m(scene);
  const Place at = from_centre(scene, place);
  return fmt::format("{}, {}", region_words(at, size.x, size.y), from_middle_words(at));
}

}  // namespace

std::string region_words(Place place, double size_x_m, double size_y_m) {
  constexpr std::array kRegions{"upper left",   "upper middle", "upper right",  "middle left", "centre",
                                "middle right", "lower left",   "lower middle", "lower right"};
  const std::size_t column = place.x_m < -size_x_m / 6.0 ? 0 : place.x_m > size_x_m / 6.0 ? 2 : 1;
  const std::size_t row = place.y_m > size_y_m / 6.0 ? 0 : place.y_m < -size_y_m / 6.0 ? 2 : 1;
  return tr(kRegions[3 * row + column]);
}

std::string counted_places(const std::vector<std::string>& places) {
  std::vector<std::string> words;
  for (auto at = places.begin(); at != places.end(); ++at) {
    if (std::find(places.begin(), at, *at) != at) continue;
    const auto count = std::count(at, places.end(), *at);
    words.push_back(count == 1 ? *at : fmt::format("{} {}", count, *at));
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

std::string offset_words(double dx_m, double dy_m) {
  std::vector<std::string> parts;
  if (std::abs(dx_m) >= kHere_m)
    parts.push_back(phrase(dx_m > 0.0 ? "{} right" : "{} left", spoken_length(std::abs(dx_m))));
  if (std::abs(dy_m) >= kHere_m)
    parts.push_back(phrase(dy_m > 0.0 ? "{} up" : "{} down", spoken_length(std::abs(dy_m))));
  return parts.empty() ? tr("here") : fmt::format("{}", fmt::join(parts, ", "));
}

std::string from_middle_words(Place place) {
  const std::string offset = offset_words(place.x_m, place.y_m);
  return offset == tr("here") ? tr("at the middle") : phrase("{} from the middle", offset);
}

std::string slope_words(double dzdx, double dzdy) {
  constexpr double kLevel = 0.03, kGentle = 0.15, kSteep = 0.8;
  constexpr std::array kWays{"to the right", "to the upper right", "to the top",    "to the upper left",
                             "to the left",  "to the lower left",  "to the bottom", "to the lower right"};
  const double steepness = std::hypot(dzdx, dzdy);
  if (!(steepness >= kLevel)) return tr("level");
  const double eighths = std::atan2(dzdy, dzdx) / (0.25 * std::numbers::pi);
  const auto way = static_cast<std::size_t>((std::lround(eighths) + 8) % 8);
  const char* const rising = steepness > kSteep    ? "rising steeply {}"
                             : steepness < kGentle ? "rising gently {}"
                                                   : "rising {}";
  return phrase(rising, tr(kWays[way]));
}

std::string heading_words(double heading_rad) {
  constexpr std::array kEighths{"up",   "up and left",    "left",  "down and left",
                                "down", "down and right", "right", "up and right"};
  // Rounded to whole degrees, as they are spoken.
  const long degrees = (std::lround(heading_rad * 180.0 / std::numbers::pi) % 360 + 360) % 360;
  if (degrees % 45 == 0) return tr(kEighths[static_cast<std::size_t>(degrees / 45)]);
  const long quarter = (degrees + 45) / 90, turned = degrees - 90 * quarter;
  const std::string along = tr(kEighths[static_cast<std::size_t>(2 * (quarter % 4))]);
  const std::string by = spoken_angle(static_cast<double>(turned) * std::numbers::pi / 180.0);
  return phrase(turned > 0 ? "{}, turned {} left" : "{}, turned {} right", along, by);
}

std::string line_words(double angle_rad) {
  constexpr std::array kWays{"from left to right", "from lower left to upper right", "up and down",
                             "from upper left to lower right"};
  const long quarters = std::lround(angle_rad / (0.25 * std::numbers::pi));
  return tr(kWays[static_cast<std::size_t>((quarters % 4 + 4) % 4)]);
}

bool is_at_route_end(const models::Scene& scene, Place place) {
  constexpr double kAtEnd_m = 0.003;
  if (scene.guide == nullptr || scene.guide->line_m.empty()) return false;
  const auto& end = scene.guide->line_m.back();
  return std::hypot(end[0] - place.x_m, end[1] - place.y_m) <= kAtEnd_m;
}

std::string name_at(const models::Scene& scene, Place place) {
  if (is_at_route_end(scene, place)) return tr(kRouteEnd);
  if (const auto* written = written_at(scene, place)) return written->name;
  const models::Material& material = scene.materials[models::label_at(scene, {{place.x_m, place.y_m, 0.0}})];
  return material.name == models::Material{}.name ? std::string() : known(material.name);
}

std::string position_words(const models::Scene& scene, double height_factor, Place place,
                           const PlaceGuide& guide) {
  const models::BoundaryMap* const map = boundaries_of(scene);
  const std::string what = map != nullptr                  ? capitalised(line_at(*map, place))
                           : is_beside_solid(scene, place) ? capitalised(beside_words(scene, place))
                                                           : capitalised(height_name(scene)) + " " +
                                                                 surface_at(scene, height_factor, place);
  if (scene.map == nullptr)
    return fmt::format("{}. {}.{}", capitalised(where(scene, place)), what, names_here(scene, place, guide));
  const MapGuide streets(scene, MapStreets::felt);
  return fmt::format("{}.{} {} {}", capitalised(where(scene, place)), names_here(scene, place, guide),
                     map_position_words(streets, place), around_words(streets, place));
}

std::string step_words(const models::Scene& scene, double height_factor, Place place) {
  const models::BoundaryMap* const map = boundaries_of(scene);
  // On a map the names are what counts.
  if (scene.map != nullptr) return name_at(scene, place);
  if (is_beside_solid(scene, place)) {
    const auto* written = written_at(scene, place);
    return (written != nullptr ? written->name + ", " : std::string()) + beside_words(scene, place);
  }
  const std::string what = map != nullptr ? line_at(*map, place) : surface_at(scene, height_factor, place);
  const std::string name = name_at(scene, place);
  return name.empty() ? what : fmt::format("{}, {}", name, what);
}

std::string press_words(const models::Scene& scene, Place place, double press_m) {
  if (press_m > 0.0 && is_beside_solid(scene, place))
    return phrase("nothing to press: {}", beside_words(scene, place));
  return press_m >= 0.0 ? phrase("pressed {} deep", spoken_length(press_m))
                        : phrase("lifted by {}", spoken_length(-press_m));
}

std::string felt_words(const models::Scene& scene, double height_factor, Place place, double force_N) {
  const double height_m =
      height_factor * (models::relief_of(scene)->sample(place.x_m, place.y_m).z_m - base_of(scene));
  const std::string what = is_beside_solid(scene, place)
                               ? beside_words(scene, place)
                               : fmt::format("{} {}", height_name(scene), spoken_length(height_m));
  const std::string name = name_at(scene, place);
  return phrase("{}, {}, force {}{}", where(scene, place), what, spoken_force(force_N),
                name.empty() ? "" : ", " + name);
}

}  // namespace palpable::describe
