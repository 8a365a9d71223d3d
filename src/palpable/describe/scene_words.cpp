// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/scene_words.hpp"

#include "palpable/describe/contour_words.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/map_route_words.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_guide.hpp"
#include "palpable/describe/solid_words.hpp"
#include "palpable/models/field/solid_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

// Further objects are only counted: nobody would remember them.
constexpr std::size_t kMostListed = 8;

/// A peak, or a region that has a name.
struct Object {
  std::string name;
  Peak peak;
};

/// The label of the ground: the label of more than half of the scene's border; nullopt if there is none.
std::optional<std::size_t> ground_label(const models::Scene& scene) {
  const Raster<std::uint8_t>& labels = scene.labels;
  if (labels.empty()) return std::nullopt;
  std::map<std::size_t, int> counts;
  int rim = 0;
  const auto count = [&](int x, int y) { ++counts[labels(x, y)], ++rim; };
  for (int x = 0; x < labels.width(); ++x) count(x, 0), count(x, labels.height() - 1);
  for (int y = 0; y < labels.height(); ++y) count(0, y), count(labels.width() - 1, y);
  for (const auto& [label, times] : counts)
    if (2 * times > rim) return label;
  return std::nullopt;
}

std::string ground_name(const models::Scene& scene) {
  const auto label = ground_label(scene);
  const std::string& name = scene.materials[label.value_or(0)].name;
  return label && name != models::Material{}.name ? known(name) : tr("ground");
}

/// The highest point of each named region, except the ground, that covers at least `least_area` of the scene.
std::vector<Object> named_objects(const models::Scene& scene, double least_area, double sign) {
  const Raster<std::uint8_t>& labels = scene.labels;
  if (labels.empty()) return {};
  const models::Relief& surface = *models::relief_of(scene);
  const auto ground = ground_label(scene);
  struct Region {
    Peak highest{{}, -1e9};
    std::size_t pixels = 0;
  };
  std::map<std::size_t, Region> regions;
  std::size_t seen = 0;
  // Large label images are subsampled.
  constexpr int kLongestLabelSide = 256;
  const int step = std::max(1, std::max(labels.width(), labels.height()) / kLongestLabelSide);
  for (int j = 0; j < labels.height(); j += step)
    for (int i = 0; i < labels.width(); i += step) {
      ++seen;
      const std::size_t label = labels(i, j);
      if (label == ground || scene.materials[label].name == models::Material{}.name) continue;
      const Place place{((i + 0.5) / labels.width() - 0.5) * surface.size_x_m(),
                        (0.5 - (j + 0.5) / labels.height()) * surface.size_y_m()};
      Region& region = regions[label];
      ++region.pixels;
      const double z_m = sign * surface.sample(place.x_m, place.y_m).z_m;
      if (z_m > region.highest.height_m) region.highest = {place, z_m};
    }
  std::vector<Object> objects;
  for (auto& [label, region] : regions) {
    const double share = static_cast<double>(region.pixels) / static_cast<double>(seen);
    if (share < least_area) continue;
    region.highest.height_m *= sign;
    objects.push_back({known(scene.materials[label].name), region.highest});
  }
  return objects;
}

/// The peaks with the names of their regions, the most prominent first, then named regions without a peak. A
/// named object counts once.
std::vector<Object> objects_of(const models::Scene& scene, double height_factor) {
  PeakOptions options;
  options.turned_over = height_factor < 0.0;
  std::vector<Object> named = named_objects(scene, options.least_area, options.turned_over ? -1.0 : 1.0);
  std::vector<Object> objects;
  for (const Peak& peak : find_peaks(*models::relief_of(scene), options)) {
    const std::string name = name_at(scene, peak.place);
    const auto is_named = [&name](const Object& object) { return object.name == name; };
    const bool is_known = std::any_of(named.begin(), named.end(), is_named);
    if (is_known && std::any_of(objects.begin(), objects.end(), is_named)) continue;
    objects.push_back({is_known ? name : std::string(), peak});
  }
  for (const Object& object : named)
    if (std::none_of(objects.begin(), objects.end(),
                     [&object](const Object& known) { return known.name == object.name; }))
      objects.push_back(object);
  return objects;
}

std::string size_words(const models::Scene& scene) {
  const Vec3 size = models::size_m(scene);
  return spoken_lengths(size.x, "by", size.y);
}

/// Adds a full stop if there is none.
std::string sentence(const std::string& words) {
  return words.find_last_of(".!?") + 1 == words.size() ? words : words + ".";
}

std::string at_region(const Object& object, const models::Scene& scene) {
  const Vec3 size = models::size_m(scene);
  const std::string region = region_words(object.peak.place, size.x, size.y);
  return object.name.empty() ? region : fmt::format("{}, {}", object.name, region);
}

/// How many prominent peaks are too small to be objects, as the houses of a large map, and where most of them
/// are: " 23 smaller ones, most of them upper right."; empty without any.
std::string smaller_words(const models::Scene& scene, double height_factor) {
  const models::Relief& surface = *models::relief_of(scene);
  PeakOptions options;
  options.turned_over = height_factor < 0.0;
  const double least_m2 = options.least_area * surface.size_x_m() * surface.size_y_m();
  options.least_area = 0.0;
  std::map<std::string, std::size_t> regions;
  std::size_t count = 0;
  for (const Peak& peak : find_peaks(surface, options)) {
    if (peak.area_m2 >= least_m2) continue;
    ++count;
    ++regions[region_words(peak.place, surface.size_x_m(), surface.size_y_m())];
  }
  if (count == 0) return {};
  const auto most = std::max_element(regions.begin(), regions.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  const char* const where = most->second == count      ? "{}, {}."
                            : 2 * most->second > count ? "{}, most of them {}."
                                                       : "{}, often {}.";
  return " " + phrase(where, capitalised(counted(count, "smaller one", "smaller ones")), most->first);
}

/// "The ground is tilted, rising gently to the right. "; empty for a level ground or none.
std::string tilt_words(const models::Relief& surface, double height_factor) {
  PeakOptions options;
  options.turned_over = height_factor < 0.0;
  const auto ground = tilted_ground(surface, options);
  if (!ground) return {};
  const std::string slope = slope_words(height_factor * ground->dzdx, height_factor * ground->dzdy);
  return slope == tr("level") ? std::string() : phrase("The ground is tilted, {}.", slope) + " ";
}

/// What is too low or too narrow to be an object is not counted, but may be there.
std::string no_object_words(const models::Scene& scene, double height_factor, const std::string& smaller) {
  if (!smaller.empty())
    return phrase("Nothing wide enough to be an object rises above the {}.", ground_name(scene)) + smaller;
  PeakOptions options;
  options.turned_over = height_factor < 0.0;
  const double least_m = std::abs(height_factor) * least_prominence_m(*models::relief_of(scene), options);
  return phrase("No object rises by {} millimetres or more above the {}; lower ones are not counted.",
                with_own_point(fmt::format("{:.{}f}", 1e3 * least_m, least_m < 1e-4 ? 2 : 1)),
                ground_name(scene));
}

std::string brief_of_surface(const models::Scene& scene, double height_factor,
                             const std::vector<Object>& objects) {
  const models::Relief& surface = *models::relief_of(scene);
  const double ends_m[]{height_factor * surface.lowest_m(), height_factor * surface.highest_m()};
  const auto [low_m, high_m] = std::minmax(ends_m[0], ends_m[1]);
  std::string words = phrase("{} {}, heights from {}.", sentence(name_of(scene)),
                             capitalised(size_words(scene)), spoken_lengths(low_m, "to", high_m)) +
                      " ";
  std::vector<std::string> places;
  for (std::size_t k = 0; k < std::min(objects.size(), kMostListed); ++k)
    places.push_back(at_region(objects[k], scene));
  words += tilt_words(surface, height_factor);
  const std::string smaller = smaller_words(scene, height_factor);
  if (objects.empty()) return words + no_object_words(scene, height_factor, smaller);
  const bool one = objects.size() == 1;
  words += phrase(one ? "{} rises above the {}" : "{} rise above the {}",
                  capitalised(counted(objects.size(), "object", "objects")), ground_name(scene));
  const char* const most = objects.size() > kMostListed ? tr("; the most prominent") : "";
  return words + fmt::format("{}: {}.{}", most, counted_places(places), smaller);
}

std::string objects_part(const std::vector<Object>& objects, double height_factor, Place probe,
                         const models::Scene& scene) {
  if (objects.empty()) return tr("Nothing is high and wide enough to be counted as an object.");
  PeakOptions options;
  options.turned_over = height_factor < 0.0;
  // A tilted ground may itself be higher at its edge than every object.
  const auto ground = tilted_ground(*models::relief_of(scene), options);
  const auto height_m = [&](const Object& object) {
    const Place p = object.peak.place;
    return height_factor * (object.peak.height_m - (ground ? ground->height_m(p.x_m, p.y_m) : 0.0));
  };
  const auto& highest =
      *std::max_element(objects.begin(), objects.end(),
                        [&](const Object& a, const Object& b) { return height_m(a) < height_m(b); });
  const Place at = highest.peak.place;
  std::string words = phrase(ground ? "From the probe to the highest point above the tilted ground: {}."
                                    : "From the probe to the highest point: {}.",
                             offset_words(at.x_m - probe.x_m, at.y_m - probe.y_m));
  for (std::size_t k = 0; k < std::min(objects.size(), kMostListed); ++k) {
    const Object& object = objects[k];
    words += " " + phrase("{}: top at {}, {}.", capitalised(at_region(object, scene)),
                          spoken_length(height_factor * object.peak.height_m),
                          from_middle_words(object.peak.place));
  }
  return words;
}

double mean_height_m(const models::Relief& surface, int column, int row) {
  constexpr int kPlaces = 24;
  double sum_m = 0.0;
  for (int j = 0; j < kPlaces; ++j)
    for (int i = 0; i < kPlaces; ++i) {
      const double x = (column + (i + 0.5) / kPlaces) / 3.0 - 0.5,
                   y = 0.5 - (row + (j + 0.5) / kPlaces) / 3.0;
      sum_m += surface.sample(x * surface.size_x_m(), y * surface.size_y_m()).z_m;
    }
  return sum_m / (kPlaces * kPlaces);
}

std::string nine_parts(const models::Scene& scene, double height_factor) {
  const models::Relief& surface = *models::relief_of(scene);
  constexpr std::array kRows{"Upper third, left to right: {}.", "Middle third, left to right: {}.",
                             "Lower third, left to right: {}."};
  std::string words = tr("Average heights in millimetres.");
  for (int row = 0; row < 3; ++row) {
    std::array<std::string, 3> heights;
    for (int column = 0; column < 3; ++column)
      heights[static_cast<std::size_t>(column)] =
          figure(std::round(1e3 * height_factor * mean_height_m(surface, column, row)));
    words += " " + phrase(kRows[static_cast<std::size_t>(row)], fmt::join(heights, ", "));
  }
  return words;
}

/// Of a view of the solid's own box whose pixels are no larger than the field's cells, between 256 and 512
/// along the longer side.
template <models::DistanceSurface Distance>
std::vector<std::string> parts_of_solid(const models::SolidField<Distance>& solid, const models::Scene& scene,
                                        Place probe) {
  const Vec3 size = solid.most_m - solid.least_m, middle = 0.5 * (solid.most_m + solid.least_m);
  constexpr double kFewest = 256.0, kMost = 512.0;
  const double longest_m = std::max({size.x, size.y, solid.distance.cell_m()});
  const double pixel_m = std::clamp(solid.distance.cell_m(), longest_m / kMost, longest_m / kFewest);
  const models::Relief view = models::solid_view(solid, pixel_m);
  const Place at{middle.x, middle.y};
  return solid_parts({&view, solid.least_m.z, size, scene.pose, at, at}, sentence(name_of(scene)), probe);
}

std::vector<std::string> parts_of(const models::Scene& scene, double height_factor, Place probe) {
  if (scene.map != nullptr) return map_parts(scene, probe);
  if (const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&scene.model))
    return contour_parts((*contours)->boundaries, sentence(name_of(scene)), probe);
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model))
    return parts_of_solid(**field, scene, probe);
  if (const auto* field = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model))
    return parts_of_solid(**field, scene, probe);
  const models::Relief& surface = *models::relief_of(scene);
  constexpr double kFlat_m = 1e-5;
  if (std::abs(height_factor) * (surface.highest_m() - surface.lowest_m()) < kFlat_m)
    return {phrase("{} {}, level at {}.", sentence(name_of(scene)), capitalised(size_words(scene)),
                   spoken_length(height_factor * surface.highest_m()))};
  const auto objects = objects_of(scene, height_factor);
  return {brief_of_surface(scene, height_factor, objects), objects_part(objects, height_factor, probe, scene),
          nine_parts(scene, height_factor)};
}

/// What persons named, the nearest first.
std::string names_part(const models::Scene& scene, Place probe) {
  struct Near {
    double distance_m;
    std::string words;
  };
  std::vector<Near> near;
  for (const models::PlaceName& name : scene.names) {
    auto nearest = nearest_of(scene, name, probe);
    if (name.extent == models::PlaceName::Extent::label && nearest.distance_m > 0.0)
      nearest.distance_m = std::hypot(name.at.x_m - probe.x_m, name.at.y_m - probe.y_m);
    near.push_back({nearest.distance_m,
                    fmt::format("{}, {}", name.name,
                                offset_words(nearest.at.x_m - probe.x_m, nearest.at.y_m - probe.y_m))});
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const Near& a, const Near& b) { return a.distance_m < b.distance_m; });
  std::vector<std::string> words;
  for (std::size_t k = 0; k < std::min(kMostListed, near.size()); ++k) words.push_back(near[k].words);
  const std::string more =
      near.size() > kMostListed ? " " + phrase("{} more: L lists all.", near.size() - kMostListed) : "";
  return phrase("{}, the nearest first: {}.", capitalised(counted(near.size(), "name", "names")),
                fmt::join(words, "; ")) +
         more;
}

}  // namespace

std::string name_of(const models::Scene& scene) {
  if (!scene.title.empty()) return known(scene.title);
  // Without folders, which do not help a user who touches.
  std::vector<std::string> files;
  for (const std::string& input : scene.source.inputs)
    files.push_back(std::filesystem::path(input).filename().string());
  constexpr std::size_t kMostNamed = 3;
  if (files.size() > kMostNamed) return phrase("{} and {} more files", files.front(), files.size() - 1);
  return files.empty() ? known(models::kind_of(scene.model)) : listed(files);
}

std::string opening_words(const models::Scene& scene) {
  std::string words = phrase("Ready to touch: {}", sentence(name_of(scene))) + " ";
  if (!scene.description.empty()) words += sentence(known(scene.description)) + " ";
  for (const std::string& warning : scene.warnings) words += known(warning) + " ";
  return words + tr("Press D to hear what is where, H for help.");
}

std::vector<std::string> scene_parts(const models::Scene& scene, double height_factor, Place probe) {
  auto parts = parts_of(scene, height_factor, probe);
  for (const std::string& warning : scene.warnings) parts.front() += " " + sentence(known(warning));
  if (!scene.names.empty()) parts.insert(parts.begin() + 1, names_part(scene, probe));
  if (!scene.description.empty() && scene.map == nullptr)
    parts.insert(parts.begin() + 1, sentence(known(scene.description)));
  return parts;
}
std::string scene_part(const models::Scene& scene, double height_factor, Place probe, std::size_t part) {
  const auto parts = scene_parts(scene, height_factor, probe);
  const std::size_t at = part % parts.size();
  if (parts.size() == 1) return parts.front();
  // After the last part there is nothing more: from then on the parts are repeated, and none offers more.
  if (part >= parts.size()) return at == 0 ? phrase("From the beginning: {}", parts[at]) : parts[at];
  return parts[at] + " " + tr(at + 1 < parts.size() ? "D again says more." : "That is all.");
}

}  // namespace palpable::describe
