// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How often a simulated hand, which senses heights and hears names only, reaches the end of random routes on
// maps of extracts or of generated towns: palpable_route_set [--routes N] [--width M] [--pull N] [EXTRACT…];
// with
// --pull a hand that only presses, and is led by this pull in newtons.
#include "palpable/core/text/number_text.hpp"
#include "palpable/recipes/map_recipe.hpp"
#include "palpable/sculpt/streets/tactile_rules.hpp"
#include "palpable/sources/map/extract_window.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "drawn_maps.hpp"
#include "pulled_hand.hpp"
#include "route_follower.hpp"
#include <fmt/format.h>

namespace palpable::bench {
namespace {

struct Trial {
  int routes = 0;
  int reached = 0;
  /// By the pulled hand: energy beyond the guide's reserve.
  double made_J = 0.0;
};

/// A random place on a felt street.
models::StreetPosition random_place(const models::StreetNetwork& network, std::mt19937_64& random) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < network.map().streets.size(); ++i) lengths.push_back(network.length_px(i));
  std::discrete_distribution<std::size_t> pick(lengths.begin(), lengths.end());
  const std::size_t piece = pick(random);
  const double along = std::uniform_real_distribution<>(0.0, lengths[piece])(random);
  return {piece, along, models::place_along(network.map().streets[piece].points, along), 0.0};
}

/// The scene with a guide along a route, whose streets are smooth and all others rough, as for `touch
/// --route`.
models::Scene guided(models::Scene scene, const describe::MapGuide& guide, const models::StreetRoute& route,
                     double pull_N) {
  constexpr double kSmooth = 0.05, kRough = 0.6;
  models::RouteGuide along;
  along.force_N = pull_N;
  for (const MapPoint p : route.line) along.line_m.push_back({guide.place_of(p).x_m, guide.place_of(p).y_m});
  scene.guide = std::make_shared<const models::RouteGuide>(std::move(along));
  std::set<std::string> on_route, streets{"street"};
  for (const models::RouteLeg& leg : route.legs) on_route.insert(leg.name.empty() ? "street" : leg.name);
  for (const MapStreet& street : guide.map().streets) streets.insert(street.name);
  std::vector<bool> below(scene.materials.size(), false);
  constexpr double kStep_px = 2.0;
  for (double way_px = 0.0; way_px < route.length_px; way_px += kStep_px) {
    const describe::Place at = guide.place_of(models::place_along(route.line, way_px));
    below[models::label_at(scene, {{at.x_m, at.y_m, 0.0}})] = true;
  }
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    models::Material& material = scene.materials[k];
    const bool is_street = streets.contains(material.name);
    if (!is_street && !below[k]) continue;
    material.static_friction = on_route.contains(material.name) || !is_street ? kSmooth : kRough;
    material.dynamic_friction = models::kDynamicOfStatic * material.static_friction;
  }
  return scene;
}

Trial try_routes(const models::Scene& scene, int routes, double pull_N, std::uint64_t seed) {
  constexpr double kShortest_m = 0.02, kReached_m = 0.006;
  constexpr int kMostDraws = 50;
  const describe::MapGuide guide(scene, describe::MapStreets::felt);
  std::mt19937_64 random(seed);
  Trial trial;
  haptics::DilatedRelief kept;
  for (int draw = 0; trial.routes < routes && draw < kMostDraws * routes; ++draw) {
    const auto from = random_place(guide.network(), random), to = random_place(guide.network(), random);
    const auto route = guide.network().route(from, to);
    if (!route || guide.metres_on_device(route->length_px) < kShortest_m) continue;
    ++trial.routes;
    const auto end = pull_N > 0.0
                         ? pulled_hand(guided(scene, guide, *route, pull_N), kept, trial.made_J)
                         : follow_route(scene, guide.place_of(from.at), spoken_legs(guide, *route), {});
    const auto goal = guide.place_of(to.at);
    if (std::hypot(end.x_m - goal.x_m, end.y_m - goal.y_m) <= kReached_m) ++trial.reached;
  }
  return trial;
}

struct Arguments {
  int routes = 200;
  double width_m = 600.0;
  double pull_N = 0.0;
  std::vector<std::string> extracts;
};

std::optional<Arguments> arguments_from(int count, char** values) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    const bool has_value = i + 1 < count;
    if (std::strcmp(values[i], "--routes") == 0 && has_value) {
      arguments.routes = static_cast<int>(finite_number(values[++i]).value_or(0.0));
    } else if (std::strcmp(values[i], "--width") == 0 && has_value) {
      arguments.width_m = finite_number(values[++i]).value_or(0.0);
    } else if (std::strcmp(values[i], "--pull") == 0 && has_value) {
      arguments.pull_N = finite_number(values[++i]).value_or(-1.0);
    } else {
      arguments.extracts.emplace_back(values[i]);
    }
  }
  if (arguments.routes < 1 || !(arguments.width_m >= 50.0) || !(arguments.pull_N >= 0.0) ||
      !(arguments.pull_N <= models::kMaxGuideForce_N))
    return std::nullopt;
  return arguments;
}

/// One line: how many routes were followed to their ends, and what breaks the tactile rules.
bool report(const std::string& name, const sources::MapExtract& extract, const Arguments& arguments) {
  sources::ExtractWindow window;
  window.width_m = arguments.width_m;
  const auto map = sources::street_map_of(extract, window);
  if (!map) return fmt::print("{}: {}\n", name, map.error().sentence()), false;
  const auto relief = sculpt::relief_from_street_map(map->map, {});
  const auto made = recipes::map_from_extract(map->map, {});
  if (!made || !relief) return fmt::print("{}: {}\n", name, made.error().sentence()), false;
  const auto violations = sculpt::check_tactile_rules(relief->relief, relief->parts, {});
  const Trial trial = try_routes(made->scene, arguments.routes, arguments.pull_N, 1);
  fmt::print("{}, {:.0f} m: {} of {} routes reached ({:.1f} %); {} violations of the tactile rules\n", name,
             arguments.width_m, trial.reached, trial.routes,
             100.0 * trial.reached / std::max(1, trial.routes), violations.size());
  if (arguments.pull_N > 0.0)
    fmt::print("  pulled with {} N; energy made: {:.2g} J\n", arguments.pull_N, trial.made_J);
  for (const auto& v : violations)
    fmt::print("  {}: {:.2f}, {:.2f} mm: {:.2f} mm\n", sculpt::words_of(v.rule), 1e3 * v.x_m, 1e3 * v.y_m,
               1e3 * v.measured_m);
  return true;
}

int run(int count, char** values) {
  const auto arguments = arguments_from(count, values);
  if (!arguments) return fmt::print("palpable_route_set [--routes N] [--width M] [--pull N] [EXTRACT…]\n"), 2;
  for (const std::string& path : arguments->extracts) {
    const auto extract = sources::read_map_extract(path);
    if (!extract) return fmt::print("{}\n", extract.error().sentence()), 3;
    report(path, *extract, *arguments);
  }
  constexpr std::uint64_t kTowns = 4;
  if (arguments->extracts.empty())
    for (std::uint64_t seed = 0; seed < kTowns; ++seed)
      report(fmt::format("town {}", seed), drawn_town(seed), *arguments);
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** values) { return palpable::bench::run(count, values); }
