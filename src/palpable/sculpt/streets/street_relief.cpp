// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/street_relief.hpp"

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

/// From pixels of the map to samples of the relief.
struct Grid {
  int columns = 0;
  int rows = 0;
  /// Samples for one pixel of the map, and for one metre.
  double of_pixel = 1.0;
  double of_metre = 1.0;

  cv::Point2d at(MapPoint p) const { return {(p.x + 0.5) * of_pixel - 0.5, (p.y + 0.5) * of_pixel - 0.5}; }
};

Grid grid_for(const StreetMap& map, const StreetReliefOptions& options) {
  const double longer = std::max(map.width_px, map.height_px);
  Grid grid;
  grid.of_pixel = options.samples / longer;
  grid.columns = std::max(2, static_cast<int>(std::lround(map.width_px * grid.of_pixel)));
  grid.rows = std::max(2, static_cast<int>(std::lround(map.height_px * grid.of_pixel)));
  const double sample_m = std::min(options.width_m / grid.columns, options.height_m / grid.rows);
  grid.of_metre = 1.0 / sample_m;
  return grid;
}

/// Distance from a place to the nearest street, as a part of half its groove's width, and which street.
struct NearestStreet {
  Raster<float> part;
  Raster<std::int32_t> street;
};

double groove_width_m(const MapStreet& street, const Grid& grid, const StreetReliefOptions& options) {
  return std::clamp(street.width_px * grid.of_pixel / grid.of_metre, options.narrowest_street_m,
                    options.widest_street_m);
}

NearestStreet nearest_streets(const StreetMap& map, const Grid& grid, const StreetReliefOptions& options) {
  NearestStreet out{Raster<float>(grid.columns, grid.rows, 1.0F),
                    Raster<std::int32_t>(grid.columns, grid.rows, -1)};
  for (std::size_t i = 0; i < map.streets.size(); ++i) {
    const MapStreet& street = map.streets[i];
    const double half = 0.5 * groove_width_m(street, grid, options) * grid.of_metre;
    for (std::size_t k = 1; k < street.points.size(); ++k) {
      const cv::Point2d a = grid.at(street.points[k - 1]);
      const cv::Point2d d = grid.at(street.points[k]) - a;
      const double square = d.dot(d);
      const int left = std::max(0, static_cast<int>(std::min(a.x, a.x + d.x) - half));
      const int right = std::min(grid.columns - 1, static_cast<int>(std::max(a.x, a.x + d.x) + half) + 1);
      const int top = std::max(0, static_cast<int>(std::min(a.y, a.y + d.y) - half));
      const int bottom = std::min(grid.rows - 1, static_cast<int>(std::max(a.y, a.y + d.y) + half) + 1);
      for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
          const cv::Point2d p = cv::Point2d(x, y) - a;
          const double t = square > 0.0 ? std::clamp(p.dot(d) / square, 0.0, 1.0) : 0.0;
          const auto part = static_cast<float>(cv::norm(p - t * d) / half);
          if (part >= out.part(x, y)) continue;
          out.part(x, y) = part;
          out.street(x, y) = static_cast<std::int32_t>(i);
        }
    }
  }
  return out;
}

cv::Mat area_mask(const StreetMap& map, MapArea::Kind kind, const Grid& grid) {
  cv::Mat mask = cv::Mat::zeros(grid.rows, grid.columns, CV_8U);
  for (const MapArea& area : map.areas) {
    if (area.kind != kind) continue;
    std::vector<cv::Point> outline;
    for (const MapPoint p : area.outline) outline.emplace_back(grid.at(p));
    cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{outline}, cv::Scalar(255));
  }
  return mask;
}

/// 0 to 1 with level ends.
double smooth_step(double t) {
  const double c = std::clamp(t, 0.0, 1.0);
  return 0.5 * (1.0 - std::cos(std::numbers::pi * c));
}

/// Distance inside the mask to its border, samples; buildings keep `gap` samples away from streets.
cv::Mat inside_of(const cv::Mat& mask, const NearestStreet& nearest, double gap) {
  cv::Mat free(mask.size(), CV_8U, cv::Scalar(255));
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (nearest.street(x, y) >= 0) free.at<std::uint8_t>(y, x) = 0;
  cv::Mat from_street, distance;
  cv::distanceTransform(free, from_street, cv::DIST_L2, 5);
  const cv::Mat kept = mask & (from_street > gap);
  cv::distanceTransform(kept, distance, cv::DIST_L2, 5);
  return distance;
}

/// The materials: which one each street and junction has.
struct Naming {
  std::vector<models::Material> materials;
  std::vector<std::uint8_t> of_street;
  std::vector<std::uint8_t> of_junction;
  std::uint8_t building = 0;
  std::uint8_t water = 0;
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
std::set<std::string> names_at(const StreetMap& map, const MapJunction& junction) {
  constexpr double kNear_px = 2.0;
  std::set<std::string> names;
  for (const MapStreet& street : map.streets)
    for (const MapPoint end : {street.points.front(), street.points.back()})
      if (!street.name.empty() && std::hypot(end.x - junction.at.x, end.y - junction.at.y) <= kNear_px)
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

Naming naming_of(const StreetMap& map) {
  Naming out;
  models::Material land;
  land.name = "land";
  models::Material building = land;
  building.name = "building";
  building.static_friction = 0.5;
  building.dynamic_friction = 0.4;
  models::Material water = land;
  water.name = "water";
  water.texture = {models::TouchTexture::Kind::ridges, 0.003, 60e-6, 0.5};
  models::Material street = land;
  street.name = "street";
  street.static_friction = 0.15;
  street.dynamic_friction = 0.1;
  models::Material junction = street;
  junction.name = "junction";
  junction.texture = {models::TouchTexture::Kind::bumps, 0.0015, 25e-6, 0.0};
  out.materials = {land, building, water, street, junction};
  out.building = 1;
  out.water = 2;
  std::map<std::string, double> lengths;
  for (const MapStreet& s : map.streets)
    if (!s.name.empty()) lengths[s.name] += street_length_px(s);
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
  for (const MapStreet& s : map.streets) out.of_street.push_back(index.contains(s.name) ? index[s.name] : 3);
  for (const MapJunction& j : map.junctions) {
    const std::string words = words_of(names_at(map, j));
    const bool named =
        words != "junction" && (index.contains(words) || out.materials.size() < kMostMaterials);
    out.of_junction.push_back(named ? add(junction, words) : std::uint8_t{4});
  }
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(StreetReliefOptions& o) {
  return {
      {"narrowest_street_m", &o.narrowest_street_m, {0.0005, 0.02}, "m", "width of the narrowest groove"},
      {"widest_street_m", &o.widest_street_m, {0.0005, 0.02}, "m", "width of the widest groove"},
      {"street_depth_m", &o.street_depth_m, {0.0001, 0.01}, "m", "depth of streets below the land"},
      {"building_m", &o.building_m, {0.0, 0.02}, "m", "height of buildings above the land"},
      {"building_gap_m", &o.building_gap_m, {0.0001, 0.01}, "m", "least distance from buildings to streets"},
      {"building_wall_m", &o.building_wall_m, {0.0001, 0.01}, "m", "width of the slope of a building's wall"},
      {"water_depth_m", &o.water_depth_m, {0.0, 0.01}, "m", "depth of water below the land"},
      {"junction_part", &o.junction_part, {0.1, 3.0}, "", "size of a junction's texture, in street widths"},
      {"samples", &o.samples, {64, 4096}, "", "samples along the longer side"}};
}

Result<StreetRelief> relief_from_street_map(const StreetMap& map, const StreetReliefOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range.error();
  if (options.narrowest_street_m > options.widest_street_m)
    return Error{ErrorCode::usage, "the narrowest street is wider than the widest one", {}};
  if (map.streets.empty() || map.width_px < 1 || map.height_px < 1)
    return invalid_input("the map has no streets");
  const Grid grid = grid_for(map, options);
  const NearestStreet nearest = nearest_streets(map, grid, options);
  const cv::Mat buildings = inside_of(area_mask(map, MapArea::Kind::building, grid), nearest,
                                      options.building_gap_m * grid.of_metre);
  const cv::Mat water = inside_of(area_mask(map, MapArea::Kind::water, grid), nearest, 0.0);
  Naming naming = naming_of(map);
  Raster<float> height(grid.columns, grid.rows);
  Raster<std::uint8_t> labels(grid.columns, grid.rows);
  const double wall = options.building_wall_m * grid.of_metre;
  // The deepest place is at 0.
  const double land_m = std::max(options.street_depth_m, options.water_depth_m);
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      double z = land_m;
      if (nearest.street(x, y) >= 0) {
        z -= options.street_depth_m * (1.0 - smooth_step(nearest.part(x, y)));
        labels(x, y) = naming.of_street[static_cast<std::size_t>(nearest.street(x, y))];
      } else if (buildings.at<float>(y, x) > 0.0F) {
        z += options.building_m * smooth_step(buildings.at<float>(y, x) / wall);
        labels(x, y) = naming.building;
      } else if (water.at<float>(y, x) > 0.0F) {
        z -= options.water_depth_m * smooth_step(water.at<float>(y, x) / wall);
        labels(x, y) = naming.water;
      }
      height(x, y) = static_cast<float>(z);
    }
  for (std::size_t j = 0; j < map.junctions.size(); ++j) {
    const cv::Point2d at = grid.at(map.junctions[j].at);
    const double radius = 0.5 * options.junction_part * options.narrowest_street_m * grid.of_metre;
    for (int y = std::max(0, static_cast<int>(at.y - radius));
         y <= std::min<double>(grid.rows - 1, at.y + radius); ++y)
      for (int x = std::max(0, static_cast<int>(at.x - radius));
           x <= std::min<double>(grid.columns - 1, at.x + radius); ++x)
        if (nearest.street(x, y) >= 0 && std::hypot(x - at.x, y - at.y) <= radius)
          labels(x, y) = naming.of_junction[j];
  }
  auto relief = models::Relief::from_samples(std::move(height), 1.0 / grid.of_metre);
  if (!relief) return relief.error();
  return StreetRelief{*std::move(relief), std::move(labels), std::move(naming.materials),
                      naming.left_out_names};
}

}  // namespace palpable::sculpt
