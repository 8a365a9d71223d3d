// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/street_relief.hpp"

#include "palpable/core/text/figure.hpp"
#include "palpable/sculpt/streets/map_areas.hpp"
#include "palpable/sculpt/streets/map_grid.hpp"
#include "palpable/sculpt/streets/mask_shapes.hpp"
#include "palpable/sculpt/streets/special_places.hpp"

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
/// nearest one. It is less deep than they are, so that their lines go on in it.
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
  const double least_part =
      (options.rules.least_relief_m + 2.0 * options.rules.height_tolerance_m) / options.street_depth_m;
  const double floor_part = std::clamp(std::max(options.merging.floor, least_part), 0.0, 1.0);
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
      depth = std::max(depth,
                       static_cast<float>(floor_part * weight * smooth_step(after.at<float>(y, x) / half)));
    }
  spread_streets(nearest.street, out.mask, merged);
  out.mask = merged;
  return out;
}

double junction_size_m(const StreetReliefOptions& options) {
  return options.junction_part * options.narrowest_street_m;
}

/// Junctions of felt streets get their own material.
void mark_junctions(const StreetMap& map, const MapGrid& grid, const StreetReliefOptions& options,
                    const NearestStreet& nearest, const MapMaterials& naming, Raster<std::uint8_t>& labels) {
  for (std::size_t j = 0; j < map.junctions.size(); ++j) {
    const MapPoint at = grid.at(map.junctions[j].at);
    const double radius = 0.5 * junction_size_m(options) * grid.of_metre;
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
          {"floor", &o.floor, {0, 1}, "", "depth between merged grooves, of that of a street"},
          {"smoothing", &o.smoothing, {0.5, 20}, "samples", "blur of the depth of merged grooves"},
          {"fade", &o.fade, {0.1, 50}, "samples", "difference over which it replaces the single ones"}};
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
  append_parameters(all, "places", parameters_of(o.places));
  return all;
}

Result<void> check(const StreetReliefOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range;
  if (options.narrowest_street_m > options.widest_street_m)
    return Error{ErrorCode::usage, "the narrowest street is wider than the widest one",
                 "narrowest_street_m, widest_street_m"};
  const MapMaterialOptions& materials = options.materials;
  if (materials.street_dynamic_friction > materials.street_static_friction ||
      materials.building_dynamic_friction > materials.building_static_friction ||
      materials.special_dynamic_friction > materials.special_static_friction)
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
  SpecialBuildings special(map, grid, grooves.mask | water.mask, options.building_gap_m, options.rules,
                           options.places);
  const FeltAreas buildings =
      felt_areas(map, MapArea::Kind::building, grid, grooves.mask | water.mask, options.building_gap_m,
                 options.rules, options.area_rounding, special.mask());
  special.keep(buildings.mask);
  MapMaterials naming = map_materials(map, selection.felt, options.junction_reach_px, options.materials);
  Raster<float> height(grid.columns, grid.rows);
  Raster<std::uint8_t> labels(grid.columns, grid.rows);
  Raster<MapPart> parts(grid.columns, grid.rows, MapPart::land);
  const cv::Mat in_building = distance_inside(buildings.mask), in_special = distance_inside(special.mask()),
                in_water = distance_inside(water.mask);
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
        z += options.places.rise_m * smooth_step(in_special.at<float>(y, x) / wall);
        const int place = special.place_at(x, y);
        labels(x, y) = place < 0 ? kBuildingMaterial : naming.of_place[static_cast<std::size_t>(place)];
        parts(x, y) = MapPart::building;
      } else if (water.mask.at<std::uint8_t>(y, x) != 0) {
        z -= options.water_depth_m * smooth_step(in_water.at<float>(y, x) / wall);
        labels(x, y) = kWaterMaterial;
        parts(x, y) = MapPart::water;
      }
      height(x, y) = static_cast<float>(z);
    }
  mark_junctions(map, grid, options, nearest, naming, labels);
  std::vector<bool> felt_places = special.felt();
  mark_places(map, grid, {options.places, options.rules, junction_size_m(options)}, parts, naming,
              felt_places, labels);
  auto relief = models::Relief::from_samples(std::move(height), 1.0 / grid.of_metre);
  if (!relief) return relief.error();
  StreetRelief out{*std::move(relief),
                   std::move(labels),
                   std::move(naming.materials),
                   std::move(parts),
                   naming.left_out_names,
                   std::move(selection),
                   {},
                   {},
                   std::move(felt_places)};
  out.buildings = {buildings.drawn, buildings.parts, buildings.left_out};
  out.waters = {water.drawn, water.parts, water.left_out};
  return out;
}

}  // namespace palpable::sculpt
