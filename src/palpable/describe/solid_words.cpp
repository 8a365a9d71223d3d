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

std::string brief_of(const SolidShape& shape, Vec3 size_m, const std::string& heading) {
  std::string words = fmt::format("{} A solid, {}, {} high. ", heading,
                                  spoken_lengths(size_m.x, "by", size_m.y), spoken_length(size_m.z));
  if (shape.pieces > 1) words += fmt::format("{}. ", capitalised(counted(shape.pieces, "piece", "pieces")));
  words += fmt::format("{} ", outline_words(shape));
  if (shape.parts.empty()) return words + fmt::format("Flat on top. {}", openings_words(shape));
  std::vector<std::string> places;
  for (std::size_t k = 0; k < std::min(shape.parts.size(), kMostParts); ++k)
    places.push_back(region_words(shape.parts[k].place, size_m.x, size_m.y));
  const char* const most = shape.parts.size() > kMostParts ? "; the most prominent" : "";
  if (shape.parts.size() > 1)
    words += fmt::format("{} rise{}: {}. ", capitalised(counted(shape.parts.size(), "part", "parts")), most,
                         fmt::join(places, "; "));
  const Peak& highest = highest_of(shape.parts);
  return words + fmt::format("{} Highest place: {}, {}.", openings_words(shape),
                             region_words(highest.place, size_m.x, size_m.y),
                             spoken_length(highest.height_m));
}

std::string details_of(const SolidShape& shape, Vec3 size_m, Place probe) {
  std::string words;
  if (!shape.parts.empty()) {
    const Place at = highest_of(shape.parts).place;
    words = fmt::format("From the probe to the highest place: {}.",
                        offset_words(at.x_m - probe.x_m, at.y_m - probe.y_m));
  }
  for (std::size_t k = 0; k < std::min(shape.parts.size(), kMostParts); ++k) {
    const Peak& part = shape.parts[k];
    const std::string rises =
        k == 0 ? "" : fmt::format(", {} above what is around it", spoken_length(part.prominence_m));
    words += fmt::format(" {}: top at {}{}, {}.", capitalised(region_words(part.place, size_m.x, size_m.y)),
                         spoken_length(part.height_m), rises, from_middle_words(part.place));
  }
  for (std::size_t k = 0; k < std::min(shape.openings.size(), kMostParts); ++k)
    words += fmt::format(" {}.", capitalised(opening_words(shape.openings[k], size_m)));
  return words;
}

}  // namespace

std::vector<std::string> solid_parts(const models::Relief& from_above, double base_m, Vec3 size_m,
                                     const std::string& heading, Place probe) {
  const SolidShape shape = solid_shape(from_above, base_m);
  return {brief_of(shape, size_m, heading), details_of(shape, size_m, probe)};
}

}  // namespace palpable::describe
