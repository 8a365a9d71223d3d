// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/surface_strokes.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/picture/raster.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace palpable::session {
namespace {

bool is_solid(const models::Scene& scene) {
  return models::is_field(scene.model) ||
         std::holds_alternative<std::shared_ptr<const models::Grid>>(scene.model);
}

using Stroke = std::vector<Point<SceneFrame>>;

/// The surface seen from above at the centres of square cells.
struct SeenFromAbove {
  double cell_m = 0.0;
  Vec3 first_m;
  Raster<double> height_m;
  /// Slope of the surface there, m/m.
  Raster<double> slope;

  Point<SceneFrame> at(int column, int row) const {
    return {{first_m.x + column * cell_m, first_m.y + row * cell_m, height_m(column, row)}};
  }
};

SeenFromAbove seen_from_above(const models::Scene& scene, int lines) {
  const models::Relief& relief = *models::relief_of(scene);
  const Vec3 size = models::size_m(scene);
  SeenFromAbove seen;
  seen.cell_m = std::max(size.x, size.y) / lines;
  const auto cells = [&](double extent) {
    return std::max(1, static_cast<int>(std::lround(extent / seen.cell_m)));
  };
  seen.height_m = Raster<double>(cells(size.x), cells(size.y));
  seen.slope = Raster<double>(seen.height_m.width(), seen.height_m.height());
  const Vec3 half{0.5 * (seen.height_m.width() - 1) * seen.cell_m,
                  0.5 * (seen.height_m.height() - 1) * seen.cell_m, 0.0};
  seen.first_m = models::centre_m(scene) - half;
  for (int row = 0; row < seen.height_m.height(); ++row)
    for (int column = 0; column < seen.height_m.width(); ++column) {
      const Vec3 place = seen.at(column, row).v;
      const models::HeightSample sample = relief.sample(place.x, place.y);
      seen.height_m(column, row) = sample.z_m;
      seen.slope(column, row) = std::hypot(sample.dzdx, sample.dzdy);
    }
  return seen;
}

/// Whether a place and those around it belong to the solid, and the surface is not too steep there: a hand
/// that presses on a steep place slides off it.
bool can_be_stroked(const SeenFromAbove& seen, int column, int row, double least_m, double steepest) {
  if (seen.slope(column, row) > steepest) return false;
  for (int v = row - 1; v <= row + 1; ++v)
    for (int u = column - 1; u <= column + 1; ++u)
      if (!seen.height_m.contains(u, v) || seen.height_m(u, v) < least_m) return false;
  return true;
}

/// Appends the strokes of a line of `count` places.
void append_strokes(int count, const std::function<std::optional<Point<SceneFrame>>(int)>& at,
                    std::vector<Stroke>& strokes) {
  Stroke run;
  for (int k = 0; k <= count; ++k) {
    const auto place = k < count ? at(k) : std::nullopt;
    if (place) {
      run.push_back(*place);
      continue;
    }
    if (run.size() >= 2) strokes.push_back(run);
    run.clear();
  }
}

Stroke stroke_at_the_highest(const SeenFromAbove& seen) {
  Point<SceneFrame> highest{{0.0, 0.0, -std::numeric_limits<double>::infinity()}};
  for (int row = 0; row < seen.height_m.height(); ++row)
    for (int column = 0; column < seen.height_m.width(); ++column)
      if (seen.height_m(column, row) > highest.v.z) highest = seen.at(column, row);
  return {highest, highest + Vector<SceneFrame>{{0.5 * seen.cell_m, 0.0, 0.0}}};
}

std::vector<Stroke> strokes_where(const SeenFromAbove& seen, double least_m, double steepest) {
  const auto at = [&](int column, int row) {
    return can_be_stroked(seen, column, row, least_m, steepest) ? std::optional(seen.at(column, row))
                                                                : std::nullopt;
  };
  const int width = seen.height_m.width(), height = seen.height_m.height();
  std::vector<Stroke> strokes;
  for (int row = 0; row < height; ++row)
    append_strokes(
        width, [&](int k) { return at(k, row); }, strokes);
  for (int column = 0; column < width; ++column)
    append_strokes(
        height, [&](int k) { return at(column, k); }, strokes);
  return strokes;
}

std::vector<Stroke> strokes_of(const SeenFromAbove& seen, double least_m, const StrokeOptions& options) {
  std::vector<Stroke> strokes = strokes_where(seen, least_m, options.steepest);
  // A solid that is steep everywhere is stroked all the same.
  for (double factor = 2.0; strokes.empty() && factor <= 8.0; factor *= 2.0)
    strokes = strokes_where(seen, least_m, factor * options.steepest);
  if (strokes.empty()) strokes.push_back(stroke_at_the_highest(seen));
  std::stable_sort(strokes.begin(), strokes.end(),
                   [](const Stroke& a, const Stroke& b) { return a.size() > b.size(); });
  const double fewest = options.shortest * static_cast<double>(strokes.front().size());
  std::erase_if(strokes, [&](const Stroke& s) { return static_cast<double>(s.size()) < fewest; });
  return strokes;
}

}  // namespace

device::SurfaceStrokes strokes_along_solid(const models::Scene& scene,
                                           const Transform<SceneFrame, DeviceFrame>& scene_from_device,
                                           const StrokeOptions& options) {
  PALPABLE_CHECK(options.lines >= 2 && options.steepest > 0.0);
  if (!is_solid(scene)) return {};
  const double depth_m = models::size_m(scene).z;
  const double least_m = models::centre_m(scene).z + (options.raised - 0.5) * depth_m;
  const auto device_from_scene = scene_from_device.inverse();
  device::SurfaceStrokes strokes;
  for (const Stroke& stroke : strokes_of(seen_from_above(scene, options.lines), least_m, options)) {
    auto& points = strokes.emplace_back();
    points.reserve(stroke.size());
    for (const auto& place : stroke) points.push_back(device_from_scene * place);
  }
  return strokes;
}

}  // namespace palpable::session
