// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/route_option.hpp"

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/describe/map_route_words.hpp"

#include <set>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// How the material of streets without a name is called.
constexpr const char* kUnnamedMaterial = "street";

void set_frictions(const std::set<std::string>& on_route, const RouteFriction& friction,
                   models::Scene& scene) {
  std::set<std::string> streets{kUnnamedMaterial};
  for (const MapStreet& street : scene.map->streets) streets.insert(street.name);
  for (models::Material& material : scene.materials) {
    if (!streets.contains(material.name)) continue;
    material.static_friction = on_route.contains(material.name) ? friction.on_route : friction.elsewhere;
    material.dynamic_friction = models::kDynamicOfStatic * material.static_friction;
  }
}

}  // namespace

Result<std::vector<std::string>> apply_route(const std::string& route, const RouteFriction& friction,
                                             models::Scene& scene) {
  if (scene.map == nullptr) return Error{ErrorCode::usage, "only a street map has routes", "--route"};
  const describe::MapGuide guide(scene, describe::MapStreets::felt);
  const auto ends = describe::route_ends(guide, route);
  if (!ends) return Error{ends.error().code, ends.error().message, "--route"};
  const auto found = guide.network().route(ends->from, ends->to);
  if (!found)
    return Error{ErrorCode::usage, fmt::format("no streets that are felt connect '{}'", route), "--route"};
  std::set<std::string> names;
  for (const models::RouteLeg& leg : found->legs)
    names.insert(leg.name.empty() ? kUnnamedMaterial : leg.name);
  set_frictions(names, friction, scene);
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
