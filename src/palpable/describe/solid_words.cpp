// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/solid_words.hpp"

#include "palpable/core/figure.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"
#include "palpable/describe/solid_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

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
  return fmt::format("outline {}", fmt::join(words, ", "));
}

std::string openings_words(const SolidShape& shape) {
  const auto holes = static_cast<std::size_t>(std::count_if(shape.openings.begin(), shape.openings.end(),
                                                            [](const Opening& o) { return o.through; }));
  const std::size_t hollows = shape.openings.size() - holes;
  if (shape.openings.empty()) return "no openings";
  std::vector<std::string> counts;
  if (holes > 0) counts.push_back(counted(holes, "hole through it", "holes through it"));
  if (hollows > 0) counts.push_back(counted(hollows, "hollow", "hollows"));
  return listed(counts);
}

/// A place relative to the middle of the solid's box.
Place from_middle(Place place, const SolidView& solid) {
  return {place.x_m - solid.middle.x_m, place.y_m - solid.middle.y_m};
}

std::string region_of(Place place, const SolidView& solid) {
  return region_words(from_middle(place, solid), solid.size_m.x, solid.size_m.y);
}

std::string opening_words(const Opening& o, const SolidView& solid) {
  const std::string what =
      o.through ? std::string("hole through it") : fmt::format("hollow {} deep", spoken_length(o.depth_m));
  return fmt::format("{}, {}, {}, {}", what, region_of(o.place, solid),
                     spoken_lengths(o.width_m, "by", o.height_m),
                     from_middle_words(from_middle(o.place, solid)));
}

const Peak& highest_of(const std::vector<Peak>& parts) {
  return *std::max_element(parts.begin(), parts.end(),
                           [](const Peak& a, const Peak& b) { return a.height_m < b.height_m; });
}

/// How the extent towards the user is called.
struct PoseWords {
  const char* seen;
  const char* flat_surface;
  const char* rise;
  const char* foremost;
  const char* top;
  const char* from_base;
  const char* above;
  const char* averages;
};

const PoseWords& words_for(models::SolidPose pose) {
  static constexpr PoseWords kFlat{"Seen from above",
                                   "Flat on top",
                                   "rise",
                                   "highest",
                                   "top",
                                   "above its base",
                                   "above what is around it",
                                   "Average heights above its base in millimetres, where the solid is."},
      kUpright{"Seen from the front",
               "Flat in front",
               "stand out",
               "nearest",
               "front",
               "from its back",
               "in front of what is around it",
               "Average distances of its front from its back in millimetres, where the solid is."};
  return pose == models::SolidPose::flat ? kFlat : kUpright;
}

std::string extents(const SolidView& solid) {
  const Vec3 size = solid.size_m;
  const bool flat = solid.pose == models::SolidPose::flat;
  return fmt::format("{} wide, {} {} and {} {}", spoken_length(size.x), spoken_length(size.y),
                     flat ? "deep" : "high", spoken_length(size.z), flat ? "high" : "deep");
}

std::string brief_of(const SolidShape& shape, const SolidView& solid, const std::string& heading) {
  const PoseWords& pose = words_for(solid.pose);
  std::vector<std::string> seen;
  if (shape.pieces > 1) seen.push_back(counted(shape.pieces, "piece", "pieces"));
  seen.push_back(outline_words(shape));
  seen.push_back(openings_words(shape));
  std::string words =
      fmt::format("{} A solid, {}. {}: {}. ", heading, extents(solid), pose.seen, fmt::join(seen, "; "));
  if (shape.parts.empty()) return words + fmt::format("{}.", pose.flat_surface);
  std::vector<std::string> places;
  for (std::size_t k = 0; k < std::min(shape.parts.size(), kMostParts); ++k)
    places.push_back(region_of(shape.parts[k].place, solid));
  const char* const most = shape.parts.size() > kMostParts ? "; the most prominent" : "";
  if (shape.parts.size() > 1)
    words += fmt::format("{} {}{}: {}. ", capitalised(counted(shape.parts.size(), "part", "parts")),
                         pose.rise, most, fmt::join(places, "; "));
  const Peak& highest = highest_of(shape.parts);
  return words + fmt::format("{} place: {}, {} {}.", capitalised(pose.foremost),
                             region_of(highest.place, solid), spoken_length(highest.height_m - solid.base_m),
                             pose.from_base);
}

std::string details_of(const SolidShape& shape, const SolidView& solid, Place probe) {
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
    words += fmt::format(" {}: {} {} {}{}, {}.", capitalised(region_of(part.place, solid)), pose.top,
                         spoken_length(part.height_m - solid.base_m), pose.from_base, rises,
                         from_middle_words(from_middle(part.place, solid)));
  }
  for (std::size_t k = 0; k < std::min(shape.openings.size(), kMostParts); ++k)
    words += fmt::format(" {}.", capitalised(opening_words(shape.openings[k], solid)));
  return words;
}

/// The nearest of the surface's samples: beside the solid, interpolated heights are of neither.
double nearest_sample_m(const models::Relief& surface, double x_m, double y_m) {
  const auto& samples = surface.samples_m();
  const auto at = [](double share, int count) {
    return std::clamp(static_cast<int>(std::floor(share * count)), 0, count - 1);
  };
  return samples(at(x_m / surface.size_x_m() + 0.5, samples.width()),
                 at(0.5 - y_m / surface.size_y_m(), samples.height()));
}

/// The mean height of a ninth of the box where the solid is; nullopt where there is hardly any.
std::optional<double> mean_height_m(const SolidView& solid, int column, int row) {
  constexpr int kPlaces = 24;
  constexpr double kLeastShare = 0.02;
  double sum_m = 0.0;
  int count = 0;
  for (int j = 0; j < kPlaces; ++j)
    for (int i = 0; i < kPlaces; ++i) {
      const double x_m = solid.middle.x_m + ((column + (i + 0.5) / kPlaces) / 3.0 - 0.5) * solid.size_m.x,
                   y_m = solid.middle.y_m + (0.5 - (row + (j + 0.5) / kPlaces) / 3.0) * solid.size_m.y;
      const double height_m = nearest_sample_m(*solid.surface, x_m, y_m) - solid.base_m;
      if (!is_of_solid(height_m, solid.size_m.z)) continue;
      sum_m += height_m;
      ++count;
    }
  if (count < kLeastShare * kPlaces * kPlaces) return std::nullopt;
  return sum_m / count;
}

std::string ninths_of(const SolidView& solid) {
  constexpr std::array kRows{"Upper", "Middle", "Lower"};
  std::string words = words_for(solid.pose).averages;
  for (int row = 0; row < 3; ++row) {
    std::array<std::string, 3> heights;
    for (int column = 0; column < 3; ++column) {
      const auto height_m = mean_height_m(solid, column, row);
      heights[static_cast<std::size_t>(column)] = height_m ? figure(std::round(1e3 * *height_m)) : "nothing";
    }
    words += fmt::format(" {} third, left to right: {}.", kRows[static_cast<std::size_t>(row)],
                         fmt::join(heights, ", "));
  }
  return words;
}

}  // namespace

std::vector<std::string> solid_parts(const SolidView& solid, const std::string& heading, Place probe) {
  const SolidShape shape = solid_shape(*solid.surface, solid.base_m);
  std::vector<std::string> parts{brief_of(shape, solid, heading), details_of(shape, solid, probe),
                                 ninths_of(solid)};
  std::erase(parts, std::string());
  return parts;
}

}  // namespace palpable::describe
