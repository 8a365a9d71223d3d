// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/special_places.hpp"

#include "palpable/core/geometry/map_place.hpp"
#include "palpable/sculpt/streets/mask_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

/// A part of the grid, and a mask in it.
struct LocalMask {
  cv::Rect box;
  cv::Mat mask;
};

/// The inside of an outline, if there is one, with a margin in samples around it and around a place.
LocalMask filled(const MapGrid& grid, const MapPlace& place, double margin) {
  const auto sample = [&grid](MapPoint p) {
    const MapPoint at = grid.at(p);
    return cv::Point{static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))};
  };
  std::vector<cv::Point> ring;
  for (const MapPoint p : place.outline) ring.push_back(sample(p));
  std::vector<cv::Point> all = ring;
  all.push_back(sample(place.at));
  const int more = static_cast<int>(std::ceil(margin));
  cv::Rect box = cv::boundingRect(all);
  box = cv::Rect(box.x - more, box.y - more, box.width + 2 * more, box.height + 2 * more) &
        cv::Rect(0, 0, grid.columns, grid.rows);
  LocalMask out{box, cv::Mat::zeros(box.size(), CV_8U)};
  if (ring.size() > 2 && !box.empty())
    cv::fillPoly(out.mask, std::vector<std::vector<cv::Point>>{ring}, cv::Scalar(255), cv::LINE_8, 0,
                 -box.tl());
  return out;
}

/// Calls visit(x, y) for the samples within a radius of a place, in samples.
template <class Visit>
void each_within(const MapGrid& grid, MapPoint at, double radius, const Visit& visit) {
  const auto first = [radius](double v) { return std::max(0, static_cast<int>(std::ceil(v - radius))); };
  const auto last = [radius](double v, int count) {
    return std::min(count - 1, static_cast<int>(std::floor(v + radius)));
  };
  for (int y = first(at.y); y <= last(at.y, grid.rows); ++y)
    for (int x = first(at.x); x <= last(at.x, grid.columns); ++x)
      if (std::hypot(x - at.x, y - at.y) <= radius) visit(x, y);
}

/// The nearest sample within reach that a filter accepts.
template <class Accepts>
std::optional<MapPoint> nearest_sample(const MapGrid& grid, MapPoint at, double reach,
                                       const Accepts& accepts) {
  std::optional<MapPoint> best;
  double least = std::numeric_limits<double>::infinity();
  each_within(grid, at, reach, [&](int x, int y) {
    const double distance = std::hypot(x - at.x, y - at.y);
    if (distance >= least || !accepts(x, y)) return;
    least = distance;
    best = MapPoint{1.0 * x, 1.0 * y};
  });
  return best;
}

bool is_in_street(MapPlace::Kind kind) {
  return kind != MapPlace::Kind::entrance && !is_special_building(kind);
}

/// The larger ones of two places that are too near are marked first, crossings with tactile paving before
/// plain ones.
std::vector<std::size_t> patches_by_importance(const StreetMap& map) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < map.places.size(); ++i)
    if (!is_special_building(map.places[i].kind) && map.places[i].kind != MapPlace::Kind::roundabout)
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&map](std::size_t a, std::size_t b) {
    const auto rank = [&map](std::size_t i) {
      const MapPlace& place = map.places[i];
      return std::pair(place.kind == MapPlace::Kind::entrance, !place.tactile_paving && place.name.empty());
    };
    return rank(a) < rank(b);
  });
  return order;
}

/// The grooves of a roundabout: what its ring surrounds, or a circle where it has none.
bool mark_roundabout(const MapPlace& place, const MapGrid& grid, const PlaceMarks& marks,
                     const Raster<MapPart>& parts, std::uint8_t label, Raster<std::uint8_t>& labels) {
  const double half_groove = 0.5 * marks.rules.least_groove_m * grid.of_metre;
  LocalMask area = filled(grid, place, 2.0 * half_groove + 2.0);
  if (area.box.empty()) return false;
  each_within(grid, grid.at(place.at), half_groove, [&](int x, int y) {
    if (area.box.contains({x, y})) area.mask.at<std::uint8_t>(cv::Point{x, y} - area.box.tl()) = 255;
  });
  area.mask = dilated(area.mask, half_groove);
  bool any = false;
  for (int y = area.box.y; y < area.box.br().y; ++y)
    for (int x = area.box.x; x < area.box.br().x; ++x) {
      if (area.mask.at<std::uint8_t>(cv::Point{x, y} - area.box.tl()) == 0 || parts(x, y) != MapPart::street)
        continue;
      labels(x, y) = label;
      any = true;
    }
  return any;
}

}  // namespace

std::vector<Parameter> parameters_of(SpecialPlaceOptions& o) {
  return {{"rise_m", &o.rise_m, {0.0, 0.01}, "m", "height of special buildings above others"},
          {"symbol_m", &o.symbol_m, {0.001, 0.02}, "m", "diameter of the symbol of a small building"},
          {"reach_m", &o.reach_m, {0.0, 0.02}, "m", "greatest distance of a symbol from its building"},
          {"patch_m", &o.patch_m, {0.0005, 0.02}, "m", "diameter of the texture of stops and crossings"}};
}

SpecialBuildings::SpecialBuildings(const StreetMap& map, const MapGrid& grid, const cv::Mat& taken,
                                   double gap_m, const TactileRules& rules,
                                   const SpecialPlaceOptions& options)
    : count_(map.places.size()),
      mask_(cv::Mat::zeros(grid.rows, grid.columns, CV_8U)),
      place_(grid.rows, grid.columns, CV_32S, cv::Scalar(-1)) {
  const double radius = 0.5 * options.symbol_m * grid.of_metre, gap = gap_m * grid.of_metre;
  const double apart = rules.least_gap_m * grid.of_metre, reach = options.reach_m * grid.of_metre;
  const cv::Mat room = distance_to(taken);
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    const MapPlace& place = map.places[i];
    if (!is_special_building(place.kind)) continue;
    LocalMask area = filled(grid, place, reach + radius + apart + 2.0);
    if (area.box.empty()) continue;
    const cv::Mat from_others = distance_to(mask_(area.box));
    area.mask = opened(area.mask & (room(area.box) > gap) & (from_others > apart), radius);
    if (cv::countNonZero(area.mask) == 0) {
      const auto has_room = [&](int x, int y) {
        const bool is_inside = std::min({x, y, grid.columns - 1 - x, grid.rows - 1 - y}) >= radius;
        return is_inside && area.box.contains({x, y}) && room.at<float>(y, x) > radius + gap &&
               from_others.at<float>(cv::Point{x, y} - area.box.tl()) > radius + apart;
      };
      const auto at = nearest_sample(grid, grid.at(place.at), reach, has_room);
      if (!at) continue;
      each_within(grid, *at, radius, [&](int x, int y) {
        area.mask.at<std::uint8_t>(cv::Point{x, y} - area.box.tl()) = 255;
      });
    }
    mask_(area.box) |= area.mask;
    place_(area.box).setTo(cv::Scalar(static_cast<double>(i)), area.mask);
  }
}

void SpecialBuildings::keep(const cv::Mat& mask) {
  mask_ &= mask;
  place_.setTo(cv::Scalar(-1), mask_ == 0);
}

std::vector<bool> SpecialBuildings::felt() const {
  std::vector<bool> felt(count_, false);
  for (int y = 0; y < place_.rows; ++y)
    for (int x = 0; x < place_.cols; ++x)
      if (const int place = place_at(x, y); place >= 0) felt[static_cast<std::size_t>(place)] = true;
  return felt;
}

void mark_places(const StreetMap& map, const MapGrid& grid, const PlaceMarks& marks,
                 const Raster<MapPart>& parts, const MapMaterials& materials, std::vector<bool>& felt,
                 Raster<std::uint8_t>& labels) {
  for (std::size_t i = 0; i < map.places.size(); ++i)
    if (map.places[i].kind == MapPlace::Kind::roundabout)
      felt[i] = mark_roundabout(map.places[i], grid, marks, parts, materials.of_place[i], labels);
  const double radius = 0.5 * marks.options.patch_m * grid.of_metre;
  const double apart = marks.rules.least_gap_m * grid.of_metre;
  std::vector<MapPoint> marked;
  for (const std::size_t i : patches_by_importance(map)) {
    const MapPlace& place = map.places[i];
    const MapPart wanted = is_in_street(place.kind) ? MapPart::street : MapPart::building;
    const auto at = nearest_sample(grid, grid.at(place.at), marks.options.reach_m * grid.of_metre,
                                   [&](int x, int y) { return parts(x, y) == wanted; });
    const auto is_near = [&](MapPoint other, double distance) {
      return std::hypot(other.x - at->x, other.y - at->y) < distance;
    };
    const double junction = 0.5 * marks.junction_m * grid.of_metre + radius;
    felt[i] = at &&
              std::none_of(marked.begin(), marked.end(),
                           [&](MapPoint other) { return is_near(other, 2.0 * radius + apart); }) &&
              std::none_of(map.junctions.begin(), map.junctions.end(), [&](const MapJunction& j) {
                return wanted == MapPart::street && is_near(grid.at(j.at), junction);
              });
    if (!felt[i]) continue;
    marked.push_back(*at);
    each_within(grid, *at, radius, [&](int x, int y) {
      if (parts(x, y) == wanted) labels(x, y) = materials.of_place[i];
    });
  }
}

}  // namespace palpable::sculpt
