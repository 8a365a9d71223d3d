// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/street_relief.hpp"

#include "palpable/core/text/figure.hpp"
#include "palpable/sculpt/streets/map_areas.hpp"
#include "palpable/sculpt/streets/map_grid.hpp"
#include "palpable/sculpt/streets/mask_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

constexpr std::size_t kMostMaterials = 256;
/// Places in the list of materials; the first one is that of the land.
constexpr std::uint8_t kBuilding = 1, kWater = 2, kStreet = 3, kJunction = 4;

/// Distance from a place to the nearest felt street, as a part of half its groove's width, and which street.
struct NearestStreet {
  Raster<float> part;
  Raster<std::int32_t> street;
};

NearestStreet nearest_streets(const StreetMap& map, const MapGrid& grid, const GrooveWidths& widths,
                              const std::vector<bool>& felt) {
  NearestStreet out{Raster<float>(grid.columns, grid.rows, 1.0F),
                    Raster<std::int32_t>(grid.columns, grid.rows, -1)};
  for (std::size_t i = 0; i < map.streets.size(); ++i) {
    if (!felt[i]) continue;
    const MapStreet& street = map.streets[i];
    const double half = 0.5 * groove_width_m(street, grid, widths) * grid.of_metre;
    for (std::size_t k = 1; k < street.points.size(); ++k)
      near_segment(grid, grid.at(street.points[k - 1]), grid.at(street.points[k]), half,
                   [&](int x, int y, double distance) {
                     const auto part = static_cast<float>(distance / half);
                     if (part >= out.part(x, y)) return;
                     out.part(x, y) = part;
                     out.street(x, y) = static_cast<std::int32_t>(i);
                   });
  }
  return out;
}

/// 0 to 1 with level ends.
double smooth_step(double t) {
  const double c = std::clamp(t, 0.0, 1.0);
  return 0.5 * (1.0 - std::cos(std::numbers::pi * c));
}

/// Gives samples of `merged` the street of the nearest sample of `mask`.
void spread_streets(Raster<std::int32_t>& street, const cv::Mat& mask, const cv::Mat& merged) {
  cv::Mat distance, nearest;
  cv::distanceTransform(~mask, distance, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<std::int32_t> street_of(mask.total() + 1, -1);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask.at<std::uint8_t>(y, x) != 0)
        street_of[static_cast<std::size_t>(nearest.at<int>(y, x))] = street(x, y);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (merged.at<std::uint8_t>(y, x) != 0 && street(x, y) < 0)
        street(x, y) = street_of[static_cast<std::size_t>(nearest.at<int>(y, x))];
}

/// The grooves: where they are, and how deep as a part of the full depth.
struct Grooves {
  cv::Mat mask;
  cv::Mat depth;
};

/// The grooves with the land that is narrower than the gap between two of them. Where that makes a passage
/// between two pieces of land that is narrower than a groove, it is widened.
cv::Mat merged_grooves(const cv::Mat& mask, const MapGrid& grid, const StreetReliefOptions& options) {
  const double half_gap = 0.5 * options.rules.least_gap_m * grid.of_metre;
  const double half_groove = 0.5 * options.narrowest_street_m * grid.of_metre;
  constexpr int kMostRounds = 20;
  cv::Mat merged = closed(mask, half_gap);
  for (int round = 0; round < kMostRounds; ++round) {
    const cv::Mat narrow = narrow_parts(merged, half_groove, options.merging.tolerance);
    if (cv::countNonZero(narrow) == 0) break;
    merged = closed(merged | dilated(narrow, half_groove), half_gap);
  }
  return merged;
}

/// Land that is narrower than the gap between two grooves becomes a part of them, with the label of the
/// nearest one.
Grooves grooves_of(NearestStreet& nearest, const MapGrid& grid, const StreetReliefOptions& options) {
  Grooves out{cv::Mat::zeros(grid.rows, grid.columns, CV_8U),
              cv::Mat::zeros(grid.rows, grid.columns, CV_32F)};
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      if (nearest.street(x, y) < 0) continue;
      out.mask.at<std::uint8_t>(y, x) = 255;
      out.depth.at<float>(y, x) = static_cast<float>(1.0 - smooth_step(nearest.part(x, y)));
    }
  const cv::Mat merged = merged_grooves(out.mask, grid, options);
  const double half = 0.5 * options.narrowest_street_m * grid.of_metre;
  const cv::Mat before = distance_inside(out.mask);
  cv::Mat after = distance_inside(merged);
  // Distances to a border of samples are not smooth; they count only where grooves were merged.
  cv::GaussianBlur(after, after, {}, options.merging.smoothing);
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      if (merged.at<std::uint8_t>(y, x) == 0) continue;
      const double deeper = after.at<float>(y, x) - before.at<float>(y, x);
      const double weight = std::clamp((deeper - 1.0) / options.merging.fade, 0.0, 1.0);
      float& depth = out.depth.at<float>(y, x);
      depth = std::max(depth, static_cast<float>(weight * smooth_step(after.at<float>(y, x) / half)));
    }
  spread_streets(nearest.street, out.mask, merged);
  out.mask = merged;
  return out;
}

/// The materials: which one each street and junction has.
struct Naming {
  std::vector<models::Material> materials;
  std::vector<std::uint8_t> of_street;
  std::vector<std::uint8_t> of_junction;
  std::size_t left_out_names = 0;
};

double street_length_px(const MapStreet& street) {
  double sum = 0.0;
  for (std::size_t i = 1; i < street.points.size(); ++i)
    sum +=
        std::hypot(street.points[i].x - street.points[i - 1].x, street.points[i].y - street.points[i - 1].y);
  return sum;
}

/// The names of the streets that end at a junction, in alphabetical order.
std::set<std::string> names_at(const StreetMap& map, const MapJunction& junction, double reach_px) {
  std::set<std::string> names;
  for (const MapStreet& street : map.streets)
    for (const MapPoint end : {street.points.front(), street.points.back()})
      if (!street.name.empty() && std::hypot(end.x - junction.at.x, end.y - junction.at.y) <= reach_px)
        names.insert(street.name);
  return names;
}

std::string words_of(const std::set<std::string>& names) {
  if (names.size() < 2) return "junction";
  std::string words = "junction of ";
  std::size_t k = 0;
  for (const std::string& name : names) {
    if (k > 0) words += k + 1 == names.size() ? " and " : ", ";
    words += name;
    ++k;
  }
  return words;
}

/// Those of land, buildings, water, streets and junctions without names.
std::vector<models::Material> materials_of(const MapMaterialOptions& options) {
  models::Material land;
  land.name = "land";
  models::Material building = land;
  building.name = "building";
  building.static_friction = options.building_static_friction;
  building.dynamic_friction = options.building_dynamic_friction;
  models::Material water = land;
  water.name = "water";
  water.texture = {models::TouchTexture::Kind::ridges, options.ridge_distance_m, options.ridge_height_m,
                   options.ridge_direction_rad};
  models::Material street = land;
  street.name = "street";
  street.static_friction = options.street_static_friction;
  street.dynamic_friction = options.street_dynamic_friction;
  models::Material junction = street;
  junction.name = "junction";
  junction.texture = {models::TouchTexture::Kind::bumps, options.bump_distance_m, options.bump_height_m, 0.0};
  return {land, building, water, street, junction};
}

Naming naming_of(const StreetMap& map, const std::vector<bool>& felt, const StreetReliefOptions& options) {
  Naming out;
  out.materials = materials_of(options.materials);
  const models::Material street = out.materials[kStreet], junction = out.materials[kJunction];
  std::map<std::string, double> lengths;
  for (std::size_t i = 0; i < map.streets.size(); ++i)
    if (felt[i] && !map.streets[i].name.empty())
      lengths[map.streets[i].name] += street_length_px(map.streets[i]);
  std::vector<std::pair<double, std::string>> longest;
  for (const auto& [name, length] : lengths) longest.emplace_back(-length, name);
  std::sort(longest.begin(), longest.end());
  const std::size_t most_names = kMostMaterials - out.materials.size();
  if (longest.size() > most_names) {
    out.left_out_names = longest.size() - most_names;
    longest.resize(most_names);
  }
  std::map<std::string, std::uint8_t> index;
  const auto add = [&](models::Material material, const std::string& name) {
    const auto known = index.find(name);
    if (known != index.end()) return known->second;
    material.name = name;
    const auto number = static_cast<std::uint8_t>(out.materials.size());
    out.materials.push_back(std::move(material));
    return index[name] = number;
  };
  for (const auto& [length, name] : longest) add(street, name);
  for (const MapStreet& s : map.streets)
    out.of_street.push_back(index.contains(s.name) ? index[s.name] : kStreet);
  for (const MapJunction& j : map.junctions) {
    const std::string words = words_of(names_at(map, j, options.junction_reach_px));
    const bool named =
        words != "junction" && (index.contains(words) || out.materials.size() < kMostMaterials);
    out.of_junction.push_back(named ? add(junction, words) : kJunction);
  }
  return out;
}

/// Junctions of felt streets get their own material.
void mark_junctions(const StreetMap& map, const MapGrid& grid, const StreetReliefOptions& options,
                    const NearestStreet& nearest, const Naming& naming, Raster<std::uint8_t>& labels) {
  for (std::size_t j = 0; j < map.junctions.size(); ++j) {
    const MapPoint at = grid.at(map.junctions[j].at);
    const double radius = 0.5 * options.junction_part * options.narrowest_street_m * grid.of_metre;
    for (int y = std::max(0, static_cast<int>(at.y - radius));
         y <= std::min<double>(grid.rows - 1, at.y + radius); ++y)
      for (int x = std::max(0, static_cast<int>(at.x - radius));
           x <= std::min<double>(grid.columns - 1, at.x + radius); ++x)
        if (nearest.street(x, y) >= 0 && std::hypot(x - at.x, y - at.y) <= radius)
          labels(x, y) = naming.of_junction[j];
  }
}

/// The map's samples, none finer than a hand can feel: what is on a small plate is as large as on a large
/// one, so that finer samples would only take memory and time. Errors: usage, for a plate without room for
/// two streets.
Result<MapGrid> grid_with_room(const StreetMap& map, const StreetReliefOptions& options) {
  constexpr double kFinest_m = 20e-6;
  const MapGrid wanted = map_grid(map, options.width_m, options.height_m, options.samples);
  const double longer_m = std::max(wanted.columns, wanted.rows) / wanted.of_metre;
  const double least_m = 2.0 * options.narrowest_street_m + options.rules.least_gap_m;
  if (!(longer_m >= least_m))
    return Error{ErrorCode::usage,
                 "a map of " + figure(1000.0 * longer_m) +
                     " mm has no room for two streets beside each other, which take " +
                     figure(1000.0 * least_m) + " mm",
                 {},
                 Reason::map_too_dense};
  const int samples = std::min(options.samples, static_cast<int>(std::ceil(longer_m / kFinest_m)));
  return map_grid(map, options.width_m, options.height_m, samples);
}

}  // namespace

std::vector<Parameter> parameters_of(MergedGrooveOptions& o) {
  return {{"tolerance", &o.tolerance, {0.5, 10}, "samples", "how much a passage may be too narrow"},
          {"smoothing", &o.smoothing, {0.5, 20}, "samples", "blur of the depth of merged grooves"},
          {"fade", &o.fade, {0.1, 50}, "samples", "difference over which it replaces the single ones"}};
}

std::vector<Parameter> parameters_of(MapMaterialOptions& o) {
  constexpr double kPi = std::numbers::pi;
  return {{"street_static_friction", &o.street_static_friction, {0, 2}, "", "of streets"},
          {"street_dynamic_friction", &o.street_dynamic_friction, {0, 2}, "", "of streets"},
          {"building_static_friction", &o.building_static_friction, {0, 2}, "", "of buildings"},
          {"building_dynamic_friction", &o.building_dynamic_friction, {0, 2}, "", "of buildings"},
          {"ridge_distance_m", &o.ridge_distance_m, {0.0001, 0.02}, "m", "distance of water's ridges"},
          {"ridge_height_m", &o.ridge_height_m, {0, 0.001}, "m", "their height"},
          {"ridge_direction_rad", &o.ridge_direction_rad, {-kPi, kPi}, "rad", "their direction"},
          {"bump_distance_m", &o.bump_distance_m, {0.0001, 0.02}, "m", "distance of a junction's bumps"},
          {"bump_height_m", &o.bump_height_m, {0, 0.001}, "m", "their height"}};
}

std::vector<Parameter> parameters_of(StreetReliefOptions& o) {
  std::vector<Parameter> all{
      {"narrowest_street_m", &o.narrowest_street_m, {0.0005, 0.02}, "m", "width of the narrowest groove"},
      {"widest_street_m", &o.widest_street_m, {0.0005, 0.02}, "m", "width of the widest groove"},
      {"street_depth_m", &o.street_depth_m, {0.0001, 0.01}, "m", "depth of streets below the land"},
      {"building_m", &o.building_m, {0.0, 0.02}, "m", "height of buildings above the land"},
      {"building_gap_m", &o.building_gap_m, {0.0001, 0.01}, "m", "least distance from buildings to streets"},
      {"building_wall_m", &o.building_wall_m, {0.0001, 0.01}, "m", "width of the slope of a building's wall"},
      {"water_depth_m", &o.water_depth_m, {0.0, 0.01}, "m", "depth of water below the land"},
      {"rules.least_gap_m",
       &o.rules.least_gap_m,
       {0.0001, 0.02},
       "m",
       "least distance of two grooves or areas"},
      {"rules.least_part_m",
       &o.rules.least_part_m,
       {0.0001, 0.02},
       "m",
       "least width of a building or water"},
      {"rules.hollow_m", &o.rules.hollow_m, {0.001, 0.05}, "m", "least width of a groove that is a hollow"},
      {"rules.most_hollow",
       &o.rules.most_hollow,
       {0.0, 1.0},
       "",
       "part of the plate in hollows that is said"},
      {"area_rounding", &o.area_rounding, {0.0, 1.0}, "", "rounding of areas, of the least width of one"},
      {"junction_part",
       &o.junction_part,
       {0.1, 3.0},
       "",
       "size of a junction's texture, in narrowest grooves"},
      {"junction_reach_px", &o.junction_reach_px, {0.0, 50.0}, "px", "streets that end so near meet there"},
      {"samples", &o.samples, {64, 4096}, "", "samples along the longer side"}};
  append_parameters(all, "selection", parameters_of(o.selection));
  append_parameters(all, "merging", parameters_of(o.merging));
  append_parameters(all, "materials", parameters_of(o.materials));
  return all;
}

Result<void> check(const StreetReliefOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range;
  if (options.narrowest_street_m > options.widest_street_m)
    return Error{ErrorCode::usage, "the narrowest street is wider than the widest one",
                 "narrowest_street_m, widest_street_m"};
  const MapMaterialOptions& materials = options.materials;
  if (materials.street_dynamic_friction > materials.street_static_friction ||
      materials.building_dynamic_friction > materials.building_static_friction)
    return Error{ErrorCode::usage, "the dynamic friction is greater than the static one", "materials"};
  return {};
}

Result<StreetRelief> relief_from_street_map(const StreetMap& map, const StreetReliefOptions& options) {
  if (auto valid = check(options); !valid) return valid.error();
  if (map.streets.empty() || map.width_px < 1 || map.height_px < 1)
    return invalid_input("the map has no streets");
  const auto sampled = grid_with_room(map, options);
  if (!sampled) return sampled.error();
  const MapGrid& grid = *sampled;
  const GrooveWidths widths{options.narrowest_street_m, options.widest_street_m};
  StreetSelection selection = select_streets(map, grid, widths, options.rules, options.selection);
  NearestStreet nearest = nearest_streets(map, grid, widths, selection.felt);
  const Grooves grooves = grooves_of(nearest, grid, options);
  const FeltAreas water = felt_areas(map, MapArea::Kind::water, grid, grooves.mask, options.rules.least_gap_m,
                                     options.rules, options.area_rounding);
  const FeltAreas buildings = felt_areas(map, MapArea::Kind::building, grid, grooves.mask | water.mask,
                                         options.building_gap_m, options.rules, options.area_rounding);
  Naming naming = naming_of(map, selection.felt, options);
  Raster<float> height(grid.columns, grid.rows);
  Raster<std::uint8_t> labels(grid.columns, grid.rows);
  Raster<MapPart> parts(grid.columns, grid.rows, MapPart::land);
  const cv::Mat in_building = distance_inside(buildings.mask), in_water = distance_inside(water.mask);
  const double wall = options.building_wall_m * grid.of_metre;
  // The deepest place is at 0.
  const double land_m = std::max(options.street_depth_m, options.water_depth_m);
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      double z = land_m;
      if (grooves.mask.at<std::uint8_t>(y, x) != 0) {
        z -= options.street_depth_m * grooves.depth.at<float>(y, x);
        labels(x, y) = naming.of_street[static_cast<std::size_t>(nearest.street(x, y))];
        parts(x, y) = MapPart::street;
      } else if (buildings.mask.at<std::uint8_t>(y, x) != 0) {
        z += options.building_m * smooth_step(in_building.at<float>(y, x) / wall);
        labels(x, y) = kBuilding;
        parts(x, y) = MapPart::building;
      } else if (water.mask.at<std::uint8_t>(y, x) != 0) {
        z -= options.water_depth_m * smooth_step(in_water.at<float>(y, x) / wall);
        labels(x, y) = kWater;
        parts(x, y) = MapPart::water;
      }
      height(x, y) = static_cast<float>(z);
    }
  mark_junctions(map, grid, options, nearest, naming, labels);
  auto relief = models::Relief::from_samples(std::move(height), 1.0 / grid.of_metre);
  if (!relief) return relief.error();
  StreetRelief out{*std::move(relief),
                   std::move(labels),
                   std::move(naming.materials),
                   std::move(parts),
                   naming.left_out_names,
                   std::move(selection),
                   {},
                   {}};
  out.buildings = {buildings.drawn, buildings.parts, buildings.left_out};
  out.waters = {water.drawn, water.parts, water.left_out};
  return out;
}

}  // namespace palpable::sculpt
