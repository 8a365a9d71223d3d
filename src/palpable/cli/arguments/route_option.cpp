// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/route_option.hpp"

#include "palpable/core/geometry/map_place.hpp"
#include "palpable/describe/map_route_words.hpp"

#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// How the material of a street is called.
std::string material_name(const std::string& name, MapStreet::Kind kind) {
  return name.empty() ? std::string(kind_words(kind)) : name;
}

/// Which materials lie under a route.
std::vector<bool> materials_below(const models::Scene& scene, const describe::MapGuide& guide,
                                  const models::StreetRoute& route) {
  constexpr double kStep_px = 2.0;
  std::vector<bool> below(scene.materials.size(), false);
  for (double along_px = 0.0; along_px < route.length_px; along_px += kStep_px) {
    const describe::Place at = guide.place_of(models::place_along(route.line, along_px));
    below[models::label_at(scene, {{at.x_m, at.y_m, 0.0}})] = true;
  }
  return below;
}

/// Streets of the route, and what lies on them (junctions, crossings), become smooth, other streets rough.
void set_frictions(const std::set<std::string>& on_route, const std::vector<bool>& below,
                   const RouteFriction& friction, models::Scene& scene) {
  std::set<std::string> streets{material_name({}, MapStreet::Kind::street)};
  for (const MapStreet& street : scene.map->streets) streets.insert(material_name(street.name, street.kind));
  for (std::size_t k = 1; k < scene.materials.size(); ++k) {
    models::Material& material = scene.materials[k];
    const bool is_street = streets.contains(material.name);
    if (!is_street && !below[k]) continue;
    const bool is_smooth = !is_street || on_route.contains(material.name);
    material.static_friction = is_smooth ? friction.on_route : friction.elsewhere;
    material.dynamic_friction = models::kDynamicOfStatic * material.static_friction;
  }
}

std::shared_ptr<const models::RouteGuide> guide_along(const describe::MapGuide& guide,
                                                      const models::StreetRoute& route, double pull_N) {
  models::RouteGuide along;
  along.force_N = pull_N;
  for (const MapPoint p : route.line) {
    const describe::Place place = guide.place_of(p);
    along.line_m.push_back({place.x_m, place.y_m});
  }
  return std::make_shared<const models::RouteGuide>(std::move(along));
}

}  // namespace

Result<std::vector<std::string>> apply_route(const std::string& route, const RouteGuidance& guidance,
                                             models::Scene& scene) {
  if (scene.map == nullptr) return Error{ErrorCode::usage, "only a street map has routes", "--route"};
  const describe::MapGuide guide(scene, describe::MapStreets::felt);
  const auto ends = describe::route_ends(guide, route);
  if (!ends) return Error{ends.error().code, ends.error().message, "--route"};
  const auto found = guide.network().route(ends->from, ends->to);
  if (!found)
    return Error{ErrorCode::usage, fmt::format("no streets that are felt connect '{}'", route), "--route"};
  std::set<std::string> names;
  for (const models::RouteLeg& leg : found->legs) names.insert(material_name(leg.name, leg.kind));
  set_frictions(names, materials_below(scene, guide, *found), guidance.friction, scene);
  scene.guide = guide_along(guide, *found, guidance.pull_N);
  std::vector<std::string> words{
      fmt::format("The route from {}, {}.", route, guide.distance_words(found->length_px))};
  if (std::string detour = describe::detour_words(describe::MapGuide(scene), *found, *ends); !detour.empty())
    words.push_back(std::move(detour));
  for (std::string& sentence : describe::route_words(guide, *found)) words.push_back(std::move(sentence));
  for (const std::string& sentence : words) {
    const std::size_t needed = scene.description.size() + sentence.size() + 1;
    if (needed > models::kMaxDescriptionBytes) break;
    scene.description += (scene.description.empty() ? "" : " ") + sentence;
  }
  return words;
}

}  // namespace palpable::cli
