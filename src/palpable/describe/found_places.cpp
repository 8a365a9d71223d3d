// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/found_places.hpp"

#include "palpable/describe/contour_lines.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/map_places.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"
#include "palpable/describe/solid_shape.hpp"
#include "palpable/models/field/superquadric_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

using Extent = models::PlaceName::Extent;

// Further ones cannot be told apart by their numbers.
constexpr std::size_t kMostLines = 60, kMostHills = 12;
constexpr std::size_t kMostLinePoints = 200;

/// At most kMostLinePoints of a line's points, evenly.
std::vector<Place> thinned(const std::vector<Place>& line) {
  if (line.size() <= kMostLinePoints) return line;
  std::vector<Place> kept;
  for (std::size_t k = 0; k < kMostLinePoints; ++k)
    kept.push_back(line[k * (line.size() - 1) / (kMostLinePoints - 1)]);
  return kept;
}

std::string region_of(const models::Scene& scene, Place place) {
  const Vec3 size = models::size_m(scene), centre = models::centre_m(scene);
  return region_words({place.x_m - centre.x, place.y_m - centre.y}, size.x, size.y);
}

NamedPlace found(std::string name, Place at, Extent extent, std::vector<Place> line, std::string more) {
  NamedPlace place{{name, {}, at, extent, std::move(line)}, name};
  if (!more.empty()) place.words += ", " + more;
  return place;
}

std::string numbered(const char* what, std::size_t index) {
  return fmt::format("{} {}", tr(what), index + 1);
}

// Maps.

void add_streets(const models::Scene& scene, const MapGuide& guide, std::vector<NamedPlace>& places) {
  for (const models::NamedStreet& street : guide.streets()) {
    const models::StreetRun& run = street.runs.front();
    const Place at = guide.place_of(models::place_along(run.line, 0.5 * run.length_px));
    const bool has_label =
        scene.materials[models::label_at(scene, {{at.x_m, at.y_m, 0.0}})].name == street.name;
    std::vector<Place> line;
    if (!has_label)
      for (const MapPoint p : run.line) line.push_back(guide.place_of(p));
    places.push_back(found(street.name, at, has_label ? Extent::label : Extent::line, thinned(line), {}));
  }
}

void add_map(const models::Scene& scene, std::vector<NamedPlace>& places) {
  const MapGuide guide(scene, MapStreets::felt);
  add_streets(scene, guide, places);
  for (NamedPlace& place : named_places(guide))
    if (!place.written && place.felt) {
      place.name.line = thinned(place.name.line);
      places.push_back(std::move(place));
    }
}

// Regions.

/// Of the samples of each label the one nearest to their mean; nullopt for a label that has none.
std::vector<std::optional<Place>> middles_of(const models::Scene& scene, const Raster<std::uint8_t>& labels) {
  struct Sum {
    double x = 0.0, y = 0.0;
    std::size_t count = 0;
  };
  std::array<Sum, 256> sums{};
  for (int j = 0; j < labels.height(); ++j)
    for (int i = 0; i < labels.width(); ++i) {
      Sum& sum = sums[labels(i, j)];
      sum.x += i, sum.y += j, ++sum.count;
    }
  const Vec3 size = models::size_m(scene);
  std::vector<std::optional<Place>> middles(sums.size());
  std::vector<double> least(sums.size(), std::numeric_limits<double>::infinity());
  for (int j = 0; j < labels.height(); ++j)
    for (int i = 0; i < labels.width(); ++i) {
      const std::uint8_t label = labels(i, j);
      const auto count = static_cast<double>(sums[label].count);
      const double d = std::hypot(i - sums[label].x / count, j - sums[label].y / count);
      if (d >= least[label]) continue;
      least[label] = d;
      middles[label] =
          Place{((i + 0.5) / labels.width() - 0.5) * size.x, (0.5 - (j + 0.5) / labels.height()) * size.y};
    }
  return middles;
}

/// How many connected pieces each label has.
std::vector<int> pieces_of(const Raster<std::uint8_t>& labels) {
  std::vector<int> pieces(256, 0);
  Raster<std::uint8_t> seen(labels.width(), labels.height());
  std::vector<std::pair<int, int>> open;
  for (int j = 0; j < labels.height(); ++j)
    for (int i = 0; i < labels.width(); ++i) {
      if (seen(i, j) != 0) continue;
      ++pieces[labels(i, j)];
      seen(i, j) = 1;
      for (open.assign(1, {i, j}); !open.empty();) {
        const auto [x, y] = open.back();
        open.pop_back();
        for (int v = y - 1; v <= y + 1; ++v)
          for (int u = x - 1; u <= x + 1; ++u)
            if (labels.contains(u, v) && seen(u, v) == 0 && labels(u, v) == labels(i, j)) {
              seen(u, v) = 1;
              open.emplace_back(u, v);
            }
      }
    }
  return pieces;
}

/// Regions with a name of their own, and those without one except the first, which is what lies between.
void add_regions(const models::Scene& scene, const Raster<std::uint8_t>& labels,
                 std::vector<NamedPlace>& places) {
  const auto middles = middles_of(scene, labels);
  const auto pieces = pieces_of(labels);
  for (std::size_t label = 0; label < std::min(scene.materials.size(), middles.size()); ++label) {
    const std::string& name = scene.materials[label].name;
    const bool has_name = name != models::Material{}.name;
    if (!middles[label] || (!has_name && label == 0)) continue;
    places.push_back(found(has_name ? known(name) : phrase("region {}", label), *middles[label],
                           Extent::label, {},
                           pieces[label] > 1 ? phrase("in {} places", pieces[label]) : std::string()));
  }
}

// Lines.

void add_lines(const models::BoundaryMap& map, std::vector<NamedPlace>& places) {
  const ContourDrawing drawing = find_contour_lines(map);
  for (std::size_t k = 0; k < std::min(kMostLines, drawing.lines.size()); ++k) {
    const ContourLine& line = drawing.lines[k];
    if (line.points.size() < 2) continue;
    const Place at = line.points[line.closed ? 0 : line.points.size() / 2];
    places.push_back(
        found(drawing.lines.size() == 1 ? tr("the line") : numbered("line", k), at,
              line.closed ? Extent::area : Extent::line, thinned(line.points),
              phrase("{}, {} long", tr(line.closed ? "closed" : "open"), spoken_length(line.length_m))));
  }
}

// Solids.

/// The convex hull of places, counter-clockwise (Andrew's monotone chain).
std::vector<Place> hull_of(std::vector<Place> places) {
  std::sort(places.begin(), places.end(),
            [](Place a, Place b) { return std::pair(a.x_m, a.y_m) < std::pair(b.x_m, b.y_m); });
  std::vector<Place> hull;
  const auto add = [&hull](Place p, std::size_t least) {
    const auto turns_left = [&] {
      const Place a = hull[hull.size() - 2], b = hull.back();
      return (b.x_m - a.x_m) * (p.y_m - a.y_m) - (b.y_m - a.y_m) * (p.x_m - a.x_m) > 0.0;
    };
    while (hull.size() > least && !turns_left()) hull.pop_back();
    hull.push_back(p);
  };
  for (const Place p : places) add(p, 1);
  const std::size_t lower = hull.size();
  for (auto p = places.rbegin(); p != places.rend(); ++p) add(*p, lower);
  if (!hull.empty()) hull.pop_back();
  return hull;
}

/// The outline of a body as seen from above: that of its convex hull.
std::vector<Place> outline_of(const models::Superquadric& shape) {
  constexpr double kPieces = 8.0;
  const double largest_m = std::max({shape.size_m.x, shape.size_m.y, shape.size_m.z});
  std::vector<Place> corners;
  for (const Vec3& p : models::mesh_of(shape, largest_m / kPieces).vertices_m) corners.push_back({p.x, p.y});
  return thinned(hull_of(std::move(corners)));
}

void add_bodies(const models::Scene& scene, const std::vector<models::Superquadric>& bodies,
                std::vector<NamedPlace>& places) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Vec3 t = bodies[k].scene_from_shape.translation_m;
    auto outline = outline_of(bodies[k]);
    const Extent extent = outline.size() > 2 ? Extent::area : Extent::point;
    if (extent == Extent::point) outline.clear();
    places.push_back(found(bodies.size() == 1 ? tr("the body") : numbered("body", k), {t.x, t.y}, extent,
                           std::move(outline), region_of(scene, {t.x, t.y})));
  }
}

// Hills.

void add_hills(const models::Scene& scene, const char* what, const PeakOptions& options,
               std::vector<NamedPlace>& places) {
  std::size_t count = 0;
  for (const Peak& peak : find_peaks(*models::relief_of(scene), options)) {
    // A region with a name is found already.
    const std::size_t label = models::label_at(scene, {{peak.place.x_m, peak.place.y_m, 0.0}});
    if (label > 0 && scene.materials[label].name != models::Material{}.name) continue;
    if (count == kMostHills) return;
    places.push_back(
        found(numbered(what, count++), peak.place, Extent::point, {}, region_of(scene, peak.place)));
  }
}

template <class Distance>
void add_solid(const models::Scene& scene, const models::SolidField<Distance>& field,
               std::vector<NamedPlace>& places) {
  if (!field.primitives.empty()) return add_bodies(scene, field.primitives, places);
  const SolidShapeOptions shape;
  PeakOptions options;
  options.least_prominence = shape.least_prominence;
  options.above_ground = false;
  add_hills(scene, "part", options, places);
}

std::optional<Place> nearest_of_solid(const models::Scene& scene, Place from) {
  const models::Relief& surface = *models::relief_of(scene);
  const Vec3 size = models::size_m(scene);
  const double base_m = models::centre_m(scene).z - 0.5 * size.z;
  const auto is_solid = [&](Place p) {
    return is_of_solid(surface.sample(p.x_m, p.y_m).z_m - base_m, size.z);
  };
  if (is_solid(from)) return from;
  const auto& samples = surface.samples_m();
  std::optional<Place> best;
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < samples.height(); ++j)
    for (int i = 0; i < samples.width(); ++i) {
      const Place p{(i + 0.5 - 0.5 * samples.width()) * surface.pixel_m(),
                    (0.5 * samples.height() - j - 0.5) * surface.pixel_m()};
      const double d = std::hypot(p.x_m - from.x_m, p.y_m - from.y_m);
      if (d >= least || !is_of_solid(double{samples(i, j)} - base_m, size.z) || !is_solid(p)) continue;
      least = d;
      best = p;
    }
  if (!best) return best;
  // A little inside of the rim, where there is room.
  constexpr double kInside = 0.015;
  const double further = kInside * std::max(size.x, size.y) / least;
  const Place inside{best->x_m + further * (best->x_m - from.x_m),
                     best->y_m + further * (best->y_m - from.y_m)};
  return is_solid(inside) ? inside : *best;
}

}  // namespace

Raster<std::uint8_t> reduced_labels(const Raster<std::uint8_t>& labels, int longest_side) {
  const int step = (std::max(labels.width(), labels.height()) + longest_side - 1) / longest_side;
  if (step <= 1) return labels;
  Raster<std::uint8_t> reduced(labels.width() / step, labels.height() / step);
  for (int j = 0; j < reduced.height(); ++j)
    for (int i = 0; i < reduced.width(); ++i)
      reduced(i, j) = labels(i * step + step / 2, j * step + step / 2);
  return reduced;
}

std::vector<NamedPlace> found_places(const models::Scene& scene, const Raster<std::uint8_t>& labels) {
  std::vector<NamedPlace> places;
  if (scene.map != nullptr) {
    add_map(scene, places);
    return places;
  }
  if (!labels.empty()) add_regions(scene, labels, places);
  if (const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&scene.model))
    add_lines((*contours)->boundaries, places);
  else if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model))
    add_solid(scene, **field, places);
  else if (const auto* dense = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model))
    add_solid(scene, **dense, places);
  else
    add_hills(scene, "object", {}, places);
  return places;
}

std::optional<Place> nearest_surface(const models::Scene& scene, Place from) {
  if (models::is_field(scene.model)) return nearest_of_solid(scene, from);
  if (const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&scene.model)) {
    const auto& map = (*contours)->boundaries;
    const double all_m = map.size_x_m() + map.size_y_m();
    // A small search first: most lines are near.
    for (const double reach_m : {0.1 * all_m, all_m})
      if (const auto line = nearest_line(map, from, reach_m))
        return Place{from.x_m + line->dx_m, from.y_m + line->dy_m};
    return std::nullopt;
  }
  if (scene.map != nullptr) {
    const MapGuide guide(scene, MapStreets::felt);
    const auto on = guide.network().nearest(guide.pixel_of(from), std::numeric_limits<double>::infinity());
    return on ? std::optional(guide.place_of(on->at)) : std::nullopt;
  }
  return from;
}

Place start_place(const models::Scene& scene) {
  const Vec3 centre = models::centre_m(scene);
  const Place middle{centre.x, centre.y};
  // Lines and streets are looked for; in the air there would be nothing to begin with.
  return models::is_field(scene.model) ? nearest_surface(scene, middle).value_or(middle) : middle;
}

}  // namespace palpable::describe
