// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/solid_words.hpp"

#include "palpable/core/text/figure.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"
#include "palpable/describe/solid_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

// Further parts are only counted: nobody would remember them.
constexpr std::size_t kMostParts = 8;
constexpr double kSymmetric = 0.97;

std::string outline_words(const SolidShape& shape) {
  std::vector<std::string> words;
  if (shape.outline == OutlineKind::rectangular) words.emplace_back(tr("rectangular"));
  if (shape.outline == OutlineKind::round) words.emplace_back(tr("round"));
  if (shape.outline == OutlineKind::oval) words.emplace_back(tr("oval"));
  const bool left_right = shape.left_right >= kSymmetric, top_bottom = shape.top_bottom >= kSymmetric;
  // The other kinds are symmetric in both directions.
  if (shape.outline == OutlineKind::other)
    words.emplace_back(tr(left_right && top_bottom ? "symmetric left to right and top to bottom"
                          : left_right             ? "symmetric left to right"
                          : top_bottom             ? "symmetric top to bottom"
                                                   : "not symmetric"));
  return phrase("outline {}", fmt::join(words, ", "));
}

std::string openings_words(const SolidShape& shape) {
  const auto holes = static_cast<std::size_t>(std::count_if(shape.openings.begin(), shape.openings.end(),
                                                            [](const Opening& o) { return o.through; }));
  const std::size_t hollows = shape.openings.size() - holes;
  if (shape.openings.empty()) return tr("no openings");
  std::vector<std::string> counts;
  if (holes > 0) counts.push_back(counted(holes, "hole through it", "holes through it"));
  if (hollows > 0) counts.push_back(counted(hollows, "hollow", "hollows"));
  return listed(counts);
}

/// A place of the surface relative to the middle of the solid's box.
Place from_middle(Place place, const SolidView& solid) {
  return {place.x_m + solid.surface_at.x_m - solid.middle.x_m,
          place.y_m + solid.surface_at.y_m - solid.middle.y_m};
}

std::string region_of(Place place, const SolidView& solid) {
  return region_words(from_middle(place, solid), solid.size_m.x, solid.size_m.y);
}

std::string opening_words(const Opening& o, const SolidView& solid) {
  const std::string what =
      o.through ? std::string(tr("hole through it")) : phrase("hollow {} deep", spoken_length(o.depth_m));
  return fmt::format("{}, {}, {}, {}", what, region_of(o.place, solid),
                     spoken_lengths(o.width_m, "by", o.height_m),
                     from_middle_words(from_middle(o.place, solid)));
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
  return phrase(flat ? "{} wide, {} deep and {} high" : "{} wide, {} high and {} deep", spoken_length(size.x),
                spoken_length(size.y), spoken_length(size.z));
}

std::string part_places(std::span<const Peak> parts, const SolidView& solid) {
  std::vector<std::string> regions;
  for (const Peak& part : parts) regions.push_back(region_of(part.place, solid));
  return counted_places(regions);
}

std::string brief_of(const SolidShape& shape, const SolidView& solid, const std::string& heading) {
  const PoseWords& pose = words_for(solid.pose);
  std::vector<std::string> seen;
  if (shape.pieces > 1) seen.push_back(counted(shape.pieces, "piece", "pieces"));
  seen.push_back(outline_words(shape));
  seen.push_back(openings_words(shape));
  std::string words =
      phrase("{} A solid, {}. {}: {}.", heading, extents(solid), tr(pose.seen), fmt::join(seen, "; ")) + " ";
  if (shape.is_flat) return words + fmt::format("{}.", tr(pose.flat_surface));
  const std::size_t listed_parts = std::min(shape.parts.size(), kMostParts);
  const char* const most = shape.parts.size() > kMostParts ? tr("; the most prominent") : "";
  if (shape.parts.size() > 1)
    words += fmt::format("{} {}{}: {}. ", capitalised(counted(shape.parts.size(), "part", "parts")),
                         tr(pose.rise), most, part_places({shape.parts.data(), listed_parts}, solid));
  return words + phrase("{} place: {}, {} {}.", capitalised(tr(pose.foremost)),
                        region_of(shape.highest, solid), spoken_length(shape.highest_m - solid.base_m),
                        tr(pose.from_base));
}

std::string details_of(const SolidShape& shape, const SolidView& solid, Place probe) {
  const PoseWords& pose = words_for(solid.pose);
  std::string words;
  if (!shape.is_flat) {
    const Place at = shape.highest;
    words = phrase(
        "From the probe to the {} place: {}.", tr(pose.foremost),
        offset_words(at.x_m + solid.surface_at.x_m - probe.x_m, at.y_m + solid.surface_at.y_m - probe.y_m));
  }
  const std::size_t listed_parts = shape.is_flat ? 0 : std::min(shape.parts.size(), kMostParts);
  for (std::size_t k = 0; k < listed_parts; ++k) {
    const Peak& part = shape.parts[k];
    const std::string rises =
        k == 0 ? "" : fmt::format(", {} {}", spoken_length(part.prominence_m), tr(pose.above));
    words += fmt::format(" {}: {} {} {}{}, {}.", capitalised(region_of(part.place, solid)), tr(pose.top),
                         spoken_length(part.height_m - solid.base_m), tr(pose.from_base), rises,
                         from_middle_words(from_middle(part.place, solid)));
  }
  for (std::size_t k = 0; k < std::min(shape.openings.size(), kMostParts); ++k)
    words += fmt::format(" {}.", capitalised(opening_words(shape.openings[k], solid)));
  if (words.starts_with(' ')) words.erase(0, 1);
  return words;
}

/// The mean heights of the ninths of the box where the solid is, row by row from the upper left; NaN where
/// there is nothing of it.
std::array<double, 9> mean_heights_m(const SolidView& solid) {
  std::array<double, 9> sums{};
  std::array<int, 9> counts{};
  const auto& samples = solid.surface->samples_m();
  const auto third = [](double share) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(std::floor(3.0 * share)), 0, 2));
  };
  for (int y = 0; y < samples.height(); ++y)
    for (int x = 0; x < samples.width(); ++x) {
      const double height_m = double{samples(x, y)} - solid.base_m;
      if (!is_of_solid(height_m, solid.size_m.z)) continue;
      const Place place = from_middle({(x + 0.5 - 0.5 * samples.width()) * solid.surface->pixel_m(),
                                       (0.5 * samples.height() - y - 0.5) * solid.surface->pixel_m()},
                                      solid);
      const std::size_t ninth =
          3 * third(0.5 - place.y_m / solid.size_m.y) + third(place.x_m / solid.size_m.x + 0.5);
      sums.at(ninth) += height_m;
      ++counts.at(ninth);
    }
  for (std::size_t k = 0; k < sums.size(); ++k) sums.at(k) /= counts.at(k);
  return sums;
}

std::string ninths_of(const SolidView& solid) {
  constexpr std::array kRows{"Upper third, left to right: {}.", "Middle third, left to right: {}.",
                             "Lower third, left to right: {}."};
  std::string words = tr(words_for(solid.pose).averages);
  const std::array<double, 9> heights_m = mean_heights_m(solid);
  for (std::size_t row = 0; row < 3; ++row) {
    std::array<std::string, 3> heights;
    for (std::size_t column = 0; column < 3; ++column) {
      const double height_m = heights_m.at(3 * row + column);
      heights.at(column) = std::isnan(height_m) ? tr("nothing") : figure(std::round(1e3 * height_m));
    }
    words += " " + phrase(kRows.at(row), fmt::join(heights, ", "));
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
