// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/map_text.hpp"

#include "palpable/describe/language.hpp"
#include "palpable/describe/map_places.hpp"
#include "palpable/describe/map_words.hpp"
#include "palpable/describe/name_keys.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/scene_words.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

using models::StreetNode;
using models::StreetRun;

/// A turn of less than this is straight ahead.
constexpr double kAhead = std::numbers::pi / 6.0;

/// The run as it is read: from left to right, or from top to bottom.
StreetRun as_read(StreetRun run) {
  const MapPoint a = run.line.front(), b = run.line.back();
  const bool level = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
  if (level ? a.x <= b.x : a.y <= b.y) return run;
  std::reverse(run.line.begin(), run.line.end());
  std::reverse(run.nodes.begin(), run.nodes.end());
  std::reverse(run.pieces.begin(), run.pieces.end());
  std::reverse(run.along_px.begin(), run.along_px.end());
  for (double& along : run.along_px) along = run.length_px - along;
  return run;
}

/// "east", "east, then north-east": the directions of its quarters.
std::string course_words(const MapGuide& guide, const StreetRun& run) {
  constexpr int kParts = 4;
  std::vector<std::string> course;
  for (int k = 0; k < kParts; ++k) {
    const double bearing =
        models::bearing_of(models::place_along(run.line, k * run.length_px / kParts),
                           models::place_along(run.line, (k + 1) * run.length_px / kParts));
    std::string words = guide.direction_words(bearing);
    if (course.empty() || course.back() != words) course.push_back(std::move(words));
  }
  return fmt::format("{}", fmt::join(course, fmt::format(", {} ", tr("then"))));
}

/// The other streets at a node, by the side on which they leave a run that goes on with `bearing`.
struct Sides {
  std::set<std::string> left, right, ahead;
};

Sides sides_at(const MapGuide& guide, std::size_t node, const std::string& own, double bearing) {
  Sides sides;
  const StreetNode& here = guide.network().nodes()[node];
  for (std::size_t k = 0; k < here.pieces.size(); ++k) {
    const MapStreet& street = guide.map().streets[here.pieces[k]];
    if (street.name == own) continue;
    const double turn = std::remainder(here.bearings[k] - bearing, 2.0 * std::numbers::pi);
    auto& side = std::abs(turn) < kAhead ? sides.ahead : turn < 0.0 ? sides.left : sides.right;
    side.insert(called(street));
  }
  return sides;
}

std::string listed_names(const std::set<std::string>& names) {
  return listed(std::vector<std::string>(names.begin(), names.end()));
}

/// "Mill Lane on the left and King Street on the right", "crosses Mill Lane"; empty without other streets.
std::string meeting_words(const Sides& sides) {
  std::set<std::string> both;
  std::vector<std::string> parts;
  for (const std::string& name : sides.left)
    if (sides.right.contains(name)) both.insert(name);
  const auto rest = [&both](std::set<std::string> names) {
    for (const std::string& name : both) names.erase(name);
    return names;
  };
  const auto left = rest(sides.left), right = rest(sides.right);
  if (!both.empty()) parts.push_back(phrase("{} across", listed_names(both)));
  if (!left.empty()) parts.push_back(phrase("{} on the left", listed_names(left)));
  if (!right.empty()) parts.push_back(phrase("{} on the right", listed_names(right)));
  if (!sides.ahead.empty()) parts.push_back(phrase("{} straight ahead", listed_names(sides.ahead)));
  return listed(parts);
}

/// Where a run begins or ends: "the map's edge, middle left", "Mill Lane", "a dead end, upper left".
std::string end_words(const MapGuide& guide, std::size_t node, const std::string& own) {
  const MapPoint at = guide.network().nodes()[node].at;
  if (guide.is_at_edge(at)) return phrase("{}, {}", tr("the map's edge"), guide.region_of(at));
  std::set<std::string> names;
  for (const std::size_t piece : guide.network().nodes()[node].pieces) {
    const MapStreet& street = guide.map().streets[piece];
    if (street.name != own) names.insert(called(street));
  }
  if (names.empty()) return phrase("{}, {}", tr("a dead end"), guide.region_of(at));
  return fmt::format("{}, {}", listed_names(names), guide.region_of(at));
}

std::string run_words(const MapGuide& guide, const std::string& name, const StreetRun& as_found) {
  const StreetRun run = as_read(as_found);
  std::string words;
  if (run.nodes.front() == run.nodes.back()) {
    words = phrase("A ring, {} around, {}.", guide.distance_words(run.length_px),
                   guide.region_of(run.line.front()));
  } else {
    words = phrase("{} from {}, {}, to {}.", guide.distance_words(run.length_px),
                   end_words(guide, run.nodes.front(), name), course_words(guide, run),
                   end_words(guide, run.nodes.back(), name));
  }
  constexpr double kStep_px = 8.0;
  std::vector<std::string> meetings;
  for (std::size_t k = 1; k + 1 < run.nodes.size(); ++k) {
    const double along = run.along_px[k];
    const double bearing = models::bearing_of(models::place_along(run.line, along - kStep_px),
                                              models::place_along(run.line, along + kStep_px));
    const std::string meeting = meeting_words(sides_at(guide, run.nodes[k], name, bearing));
    if (!meeting.empty()) meetings.push_back(phrase("after {} {}", guide.distance_words(along), meeting));
  }
  if (!meetings.empty()) words += " " + phrase("On the way: {}.", fmt::join(meetings, "; "));
  return words;
}

/// Those that are felt, then the others under a heading of their own.
void add_streets(std::string& text, const MapGuide& guide, const std::vector<KeyedStreet>& keyed) {
  if (keyed.empty()) {
    text += "\nNo street has a name that was found.\n";
    return;
  }
  const auto unfelt = models::unfelt_names(guide.map());
  std::string felt_lines, unfelt_lines;
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    const bool is_felt = !std::binary_search(unfelt.begin(), unfelt.end(), keyed[i].name);
    (is_felt ? felt_lines : unfelt_lines) +=
        fmt::format("{}{}\n", keyed[i].key.empty() ? "" : fmt::format("Key {}: ", keyed[i].key),
                    street_words(guide, guide.streets()[i]));
  }
  if (!felt_lines.empty())
    text += "\nStreets, the longest first, each after its key on the tactile drawing.\n" + felt_lines;
  if (!unfelt_lines.empty())
    text +=
        "\nStreets that cannot be felt on this model: a smaller part of the map, or a larger size, shows "
        "them.\n" +
        unfelt_lines;
}

/// The nodes where streets of two names meet, from the top; of several close together with the same names
/// (two carriageways, roundabouts) one.
std::vector<std::size_t> told_junctions(const MapGuide& guide) {
  constexpr double kSame_m = 40.0, kSame_px = 20.0;
  const double metres_per_px = guide.map().metres_per_px;
  const double same_px = metres_per_px > 0.0 ? kSame_m / metres_per_px : kSame_px;
  const auto& nodes = guide.network().nodes();
  std::vector<std::size_t> told;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto names = guide.names_at(i);
    if (nodes[i].pieces.size() < 3 || names.size() < 2) continue;
    const bool known = std::any_of(told.begin(), told.end(), [&](std::size_t other) {
      return std::hypot(nodes[other].at.x - nodes[i].at.x, nodes[other].at.y - nodes[i].at.y) <= same_px &&
             guide.names_at(other) == names;
    });
    if (!known) told.push_back(i);
  }
  std::stable_sort(told.begin(), told.end(), [&nodes](std::size_t a, std::size_t b) {
    return std::pair(nodes[a].at.y, nodes[a].at.x) < std::pair(nodes[b].at.y, nodes[b].at.x);
  });
  return told;
}

void add_junctions(std::string& text, const MapGuide& guide, std::size_t most) {
  const auto told = told_junctions(guide);
  if (told.empty()) return;
  text += "\nJunctions, from the top down, with the directions in which their streets lead.\n";
  for (std::size_t k = 0; k < std::min(most, told.size()); ++k) {
    const StreetNode& node = guide.network().nodes()[told[k]];
    text += fmt::format("{}{}, {}: {}.\n", node.roundabout ? "Roundabout of " : "",
                        listed(guide.names_at(told[k])), guide.region_of(node.at),
                        bearings_words(guide, told[k]));
  }
  if (told.size() > most)
    text += fmt::format("Further junctions: {}. A smaller part of the map has fewer.\n", told.size() - most);
}

/// The regions of areas of one kind, each once: "upper left and centre".
std::string regions_of(const MapGuide& guide, MapArea::Kind kind) {
  std::vector<std::string> regions;
  for (const MapArea& area : guide.map().areas) {
    if (area.kind != kind || area.outline.empty()) continue;
    MapPoint middle;
    for (const MapPoint p : area.outline) middle = {middle.x + p.x, middle.y + p.y};
    const auto count = static_cast<double>(area.outline.size());
    std::string region = guide.region_of({middle.x / count, middle.y / count});
    if (std::find(regions.begin(), regions.end(), region) == regions.end())
      regions.push_back(std::move(region));
  }
  return listed(regions);
}

void add_places(std::string& text, const MapGuide& guide) {
  std::vector<std::string> places;
  for (const NamedPlace& place : named_places(guide))
    if (!place.kind)
      places.push_back(fmt::format("{}, {}.\n", place.words, guide.region_of(guide.pixel_of(place.name.at))));
  text += special_places_text(guide);
  if (!places.empty()) text += fmt::format("\nPlaces.\n{}", fmt::join(places, ""));
}

void add_areas(std::string& text, const MapGuide& guide) {
  const auto count = [&guide](MapArea::Kind kind) {
    return static_cast<std::size_t>(std::count_if(guide.map().areas.begin(), guide.map().areas.end(),
                                                  [kind](const MapArea& area) { return area.kind == kind; }));
  };
  text += "\n";
  if (const auto waters = count(MapArea::Kind::water); waters > 0)
    text += fmt::format("{}: {}.\n", capitalised(counted(waters, "area of water", "areas of water")),
                        regions_of(guide, MapArea::Kind::water));
  if (const auto greens = count(MapArea::Kind::green); greens > 0)
    text += fmt::format("{}: {}.\n", capitalised(counted(greens, "green area", "green areas")),
                        regions_of(guide, MapArea::Kind::green));
  text += capitalised(counted(count(MapArea::Kind::building), "building", "buildings")) + ".\n";
}

}  // namespace

std::string street_words(const MapGuide& guide, const models::NamedStreet& street) {
  std::string words =
      fmt::format("{}, {}{}{}.", street.name, guide.distance_words(street.length_px),
                  street.two_carriageways ? tr(", two carriageways") : "",
                  street.runs.size() > 1 ? ", " + phrase("in {} parts", street.runs.size()) : "");
  for (const StreetRun& run : street.runs) words += " " + capitalised(run_words(guide, street.name, run));
  return words;
}

std::string bearings_words(const MapGuide& guide, std::size_t at) {
  const StreetNode& node = guide.network().nodes()[at];
  std::map<std::string, int> counts;
  for (const double bearing : node.bearings) ++counts[guide.direction_words(bearing)];
  std::vector<std::pair<std::string, std::vector<std::string>>> streets;
  for (std::size_t k = 0; k < node.pieces.size(); ++k) {
    const std::string name = called(guide.map().streets[node.pieces[k]]);
    std::string words = guide.direction_words(node.bearings[k]);
    if (counts[words] > 1)
      words = phrase("{} at {:.0f} degrees", words, node.bearings[k] * 180.0 / std::numbers::pi);
    const auto known =
        std::find_if(streets.begin(), streets.end(), [&name](const auto& s) { return s.first == name; });
    if (known != streets.end())
      known->second.push_back(std::move(words));
    else
      streets.push_back({name, {std::move(words)}});
  }
  std::vector<std::string> parts;
  for (const auto& [name, directions] : streets)
    parts.push_back(fmt::format("{} {}", name, listed(directions)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string map_heading(const models::Scene& scene, const MapGuide& guide) {
  const StreetMap& map = guide.map();
  std::string text = phrase("Street map: {}.", name_of(scene)) + "\n";
  const double wide_m = guide.metres_on_device(map.width_px), high_m = guide.metres_on_device(map.height_px);
  if (map.metres_per_px > 0.0)
    text +=
        phrase(
            "It shows {:.0f} by {:.0f} metres; north is up. On the model of {}, one centimetre is {:.0f} "
            "metres.",
            map.width_px * map.metres_per_px, map.height_px * map.metres_per_px,
            spoken_lengths(wide_m, "by", high_m), 0.01 / guide.metres_on_device(1.0) * map.metres_per_px) +
        "\n";
  else
    text += phrase("Its scale is not known: distances are those on the model of {}.",
                   spoken_lengths(wide_m, "by", high_m)) +
            "\n";
  if (!scene.description.empty()) text += known(scene.description) + "\n";
  const auto junctions =
      static_cast<std::size_t>(std::count_if(guide.network().nodes().begin(), guide.network().nodes().end(),
                                             [](const StreetNode& node) { return node.pieces.size() > 2; }));
  const auto unnamed = std::count_if(map.streets.begin(), map.streets.end(), [](const MapStreet& s) {
    return s.name.empty() && s.kind == MapStreet::Kind::street;
  });
  text += phrase(guide.streets().size() == 1 ? "{} with a name, {}, {}." : "{} with names, {}, {}.",
                 capitalised(counted(guide.streets().size(), "street", "streets")),
                 counted(static_cast<std::size_t>(unnamed), "piece of a street without one",
                         "pieces of streets without one"),
                 counted(junctions, "junction", "junctions")) +
          "\n";
  return text;
}

std::vector<KeyedStreet> keyed_streets(const models::Scene& scene) {
  const MapGuide guide(scene);
  std::vector<std::string> names;
  for (const auto& street : guide.streets()) names.push_back(street.name);
  const auto keys = name_keys(names);
  std::vector<KeyedStreet> keyed;
  for (std::size_t i = 0; i < names.size(); ++i) keyed.push_back({names[i], keys[i]});
  return keyed;
}

std::string map_text(const models::Scene& scene, const MapTextOptions& options) {
  const MapGuide guide(scene);
  std::string text = map_heading(scene, guide);
  add_streets(text, guide, keyed_streets(scene));
  add_junctions(text, guide, options.most_junctions);
  add_places(text, guide);
  add_areas(text, guide);
  return text;
}

}  // namespace palpable::describe
