// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/solid_words.hpp"

#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"
#include "palpable/describe/solid_shape.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

// Further parts are only counted: nobody would remember them.
constexpr std::size_t kMostParts = 8;
constexpr double kSymmetric = 0.97;

std::string outline_words(const SolidShape& shape) {
  std::vector<std::string> words;
  if (shape.outline == OutlineKind::rectangular) words.emplace_back("rectangular");
  if (shape.outline == OutlineKind::round) words.emplace_back("round");
  if (shape.outline == OutlineKind::oval) words.emplace_back("oval");
  const bool left_right = shape.left_right >= kSymmetric, top_bottom = shape.top_bottom >= kSymmetric;
  // The other kinds are symmetric in both directions.
  if (shape.outline == OutlineKind::other)
    words.emplace_back(left_right && top_bottom ? "symmetric left to right and top to bottom"
                       : left_right             ? "symmetric left to right"
                       : top_bottom             ? "symmetric top to bottom"
                                                : "not symmetric");
  return fmt::format("Outline: {}.", fmt::join(words, ", "));
}

std::string openings_words(const SolidShape& shape) {
  const auto holes = static_cast<std::size_t>(std::count_if(shape.openings.begin(), shape.openings.end(),
                                                            [](const Opening& o) { return o.through; }));
  const std::size_t hollows = shape.openings.size() - holes;
  if (shape.openings.empty()) return "No openings.";
  std::vector<std::string> counts;
  if (holes > 0) counts.push_back(counted(holes, "hole through it", "holes through it"));
  if (hollows > 0) counts.push_back(counted(hollows, "hollow", "hollows"));
  return fmt::format("{}.", capitalised(listed(counts)));
}

std::string opening_words(const Opening& o, Vec3 size_m) {
  const std::string what =
      o.through ? std::string("hole through it") : fmt::format("hollow {} deep", spoken_length(o.depth_m));
  return fmt::format("{}, {}, {}, {}", what, region_words(o.place, size_m.x, size_m.y),
                     spoken_lengths(o.width_m, "by", o.height_m), from_middle_words(o.place));
}

const Peak& highest_of(const std::vector<Peak>& parts) {
  return *std::max_element(parts.begin(), parts.end(),
                           [](const Peak& a, const Peak& b) { return a.height_m < b.height_m; });
}

/// How the extent towards the user is called.
struct PoseWords {
  const char* flat_surface;
  const char* rise;
  const char* foremost;
  const char* top;
  const char* above;
};

const PoseWords& words_for(models::SolidPose pose) {
  static constexpr PoseWords kFlat{"Flat on top", "rise", "highest", "top at", "above what is around it"},
      kUpright{"Flat in front", "stand out", "nearest", "front at", "in front of what is around it"};
  return pose == models::SolidPose::flat ? kFlat : kUpright;
}

std::string extents(const SolidView& solid) {
  const Vec3 size = solid.size_m;
  const bool flat = solid.pose == models::SolidPose::flat;
  return fmt::format("{} wide, {} {} and {} {}", spoken_length(size.x), spoken_length(size.y),
                     flat ? "deep" : "high", spoken_length(size.z), flat ? "high" : "deep");
}

std::string brief_of(const SolidShape& shape, const SolidView& solid, const std::string& heading) {
  const Vec3 size_m = solid.size_m;
  const PoseWords& pose = words_for(solid.pose);
  std::string words = fmt::format("{} A solid, {}. ", heading, extents(solid));
  if (shape.pieces > 1) words += fmt::format("{}. ", capitalised(counted(shape.pieces, "piece", "pieces")));
  words += fmt::format("{} ", outline_words(shape));
  if (shape.parts.empty()) return words + fmt::format("{}. {}", pose.flat_surface, openings_words(shape));
  std::vector<std::string> places;
  for (std::size_t k = 0; k < std::min(shape.parts.size(), kMostParts); ++k)
    places.push_back(region_words(shape.parts[k].place, size_m.x, size_m.y));
  const char* const most = shape.parts.size() > kMostParts ? "; the most prominent" : "";
  if (shape.parts.size() > 1)
    words += fmt::format("{} {}{}: {}. ", capitalised(counted(shape.parts.size(), "part", "parts")),
                         pose.rise, most, fmt::join(places, "; "));
  const Peak& highest = highest_of(shape.parts);
  return words + fmt::format("{} {} place: {}, {}.", openings_words(shape), capitalised(pose.foremost),
                             region_words(highest.place, size_m.x, size_m.y),
                             spoken_length(highest.height_m));
}

std::string details_of(const SolidShape& shape, const SolidView& solid, Place probe) {
  const Vec3 size_m = solid.size_m;
  const PoseWords& pose = words_for(solid.pose);
  std::string words;
  if (!shape.parts.empty()) {
    const Place at = highest_of(shape.parts).place;
    words = fmt::format("From the probe to the {} place: {}.", pose.foremost,
                        offset_words(at.x_m - probe.x_m, at.y_m - probe.y_m));
  }
  for (std::size_t k = 0; k < std::min(shape.parts.size(), kMostParts); ++k) {
    const Peak& part = shape.parts[k];
    const std::string rises =
        k == 0 ? "" : fmt::format(", {} {}", spoken_length(part.prominence_m), pose.above);
    words += fmt::format(" {}: {} {}{}, {}.", capitalised(region_words(part.place, size_m.x, size_m.y)),
                         pose.top, spoken_length(part.height_m), rises, from_middle_words(part.place));
  }
  for (std::size_t k = 0; k < std::min(shape.openings.size(), kMostParts); ++k)
    words += fmt::format(" {}.", capitalised(opening_words(shape.openings[k], size_m)));
  return words;
}

}  // namespace

std::vector<std::string> solid_parts(const SolidView& solid, const std::string& heading, Place probe) {
  const SolidShape shape = solid_shape(*solid.surface, solid.base_m);
  return {brief_of(shape, solid, heading), details_of(shape, solid, probe)};
}

}  // namespace palpable::describe
