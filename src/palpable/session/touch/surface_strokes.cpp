// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/surface_strokes.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/raster.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
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
  const Vec3 half{0.5 * (seen.height_m.width() - 1) * seen.cell_m,
                  0.5 * (seen.height_m.height() - 1) * seen.cell_m, 0.0};
  seen.first_m = models::centre_m(scene) - half;
  for (int row = 0; row < seen.height_m.height(); ++row)
    for (int column = 0; column < seen.height_m.width(); ++column) {
      const Vec3 place = seen.at(column, row).v;
      seen.height_m(column, row) = relief.sample(place.x, place.y).z_m;
    }
  return seen;
}

/// Appends the strokes of a line of `count` places, without the places at both their ends, where the surface
/// may fall off.
void append_strokes(int count, const std::function<Point<SceneFrame>(int)>& at, double least_m,
                    double greatest_step_m, std::vector<Stroke>& strokes) {
  Stroke run;
  const auto end_run = [&] {
    if (run.size() >= 4) strokes.emplace_back(run.begin() + 1, run.end() - 1);
    run.clear();
  };
  for (int k = 0; k < count; ++k) {
    const auto place = at(k);
    if (!run.empty() && std::abs(place.v.z - run.back().v.z) > greatest_step_m) end_run();
    if (place.v.z >= least_m)
      run.push_back(place);
    else
      end_run();
  }
  end_run();
}

Stroke stroke_at_the_highest(const SeenFromAbove& seen) {
  Point<SceneFrame> highest{{0.0, 0.0, -std::numeric_limits<double>::infinity()}};
  for (int row = 0; row < seen.height_m.height(); ++row)
    for (int column = 0; column < seen.height_m.width(); ++column)
      if (seen.height_m(column, row) > highest.v.z) highest = seen.at(column, row);
  return {highest, highest + Vector<SceneFrame>{{0.5 * seen.cell_m, 0.0, 0.0}}};
}

std::vector<Stroke> strokes_of(const SeenFromAbove& seen, double least_m, const StrokeOptions& options) {
  const double greatest_step_m = options.steepest * seen.cell_m;
  std::vector<Stroke> strokes;
  for (int row = 0; row < seen.height_m.height(); ++row)
    append_strokes(
        seen.height_m.width(), [&](int k) { return seen.at(k, row); }, least_m, greatest_step_m, strokes);
  for (int column = 0; column < seen.height_m.width(); ++column)
    append_strokes(
        seen.height_m.height(), [&](int k) { return seen.at(column, k); }, least_m, greatest_step_m, strokes);
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
