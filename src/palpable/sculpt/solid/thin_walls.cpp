// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/thin_walls.hpp"

#include "palpable/core/check.hpp"
#include "palpable/sculpt/solid/nearest_in_balls.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palpable::sculpt {
namespace {

// Thin walls are thickened in this many steps of thickness: each gets what it lacks of the least thickness.
constexpr int kSteps = 4;

/// The middle of a triangle and a place near each of its corners.
std::array<Vec3, 4> places_of(const std::array<Vec3, 3>& c) {
  const Vec3 middle = (c[0] + c[1] + c[2]) / 3.0;
  constexpr double kOutwards = 0.6;
  return {middle, middle + kOutwards * (c[0] - middle), middle + kOutwards * (c[1] - middle),
          middle + kOutwards * (c[2] - middle)};
}

std::array<Vec3, 3> corners_at(const Mesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
}

/// A triangle is thin if most of its sample points are.
constexpr int kPlaces = 4, kMostPlaces = 3;

/// The wall's thickness behind a triangle, at most `least_m`. At half of that depth inside a thicker wall,
/// this face is the nearest one; inside a thin wall it is the opposite face, or the point is outside.
double thickness_behind(const DistanceSource& solid, DistanceSource::Hint& hint, const std::array<Vec3, 3>& c,
                        double least_m) {
  constexpr double kOpposite = 0.9, kTold = 0.02;
  const Vec3 normal = unit(cross(c[1] - c[0], c[2] - c[0]));
  const double depth_m = 0.5 * least_m;
  int thin = 0;
  double sum_m = 0.0;
  for (const Vec3 place : places_of(c)) {
    const models::FieldSample there = solid.at(place - depth_m * normal, hint);
    if (dot(there.gradient, normal) > -kOpposite) continue;
    const double thickness_m = depth_m - there.distance_m;
    if (thickness_m > (1.0 - kTold) * least_m || thickness_m < 0.0) continue;
    ++thin;
    sum_m += thickness_m;
  }
  return thin >= kMostPlaces ? sum_m / thin : least_m;
}

/// Finds the parts of triangles that have the solid on neither side.
class SheetFinder {
 public:
  SheetFinder(const DistanceSource& solid, double finest_m) : solid_(solid), finest_m_(finest_m) {}

  /// Adds those parts of one triangle, which is divided where they differ.
  void add(const std::array<Vec3, 3>& c, DistanceSource::Hint& hint,
           std::vector<std::array<Vec3, 3>>& sheets) const {
    // Larger triangles may contain parts of both kinds between their sample points.
    constexpr double kLargest = 32.0, kSmallest = 1.0;
    const double longest_m = std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
    const Vec3 normal = unit(cross(c[1] - c[0], c[2] - c[0]));
    int outside = 0;
    for (const Vec3 place : places_of(c)) outside += is_outside(place, normal, hint) ? 1 : 0;
    const bool is_mixed = outside > 0 && outside < kPlaces;
    if (longest_m > (is_mixed ? kSmallest : kLargest) * finest_m_) {
      const Vec3 a = 0.5 * (c[0] + c[1]), b = 0.5 * (c[1] + c[2]), d = 0.5 * (c[2] + c[0]);
      for (const auto& part : {std::array{c[0], a, d}, {a, c[1], b}, {d, b, c[2]}, {a, b, d}})
        add(part, hint, sheets);
      return;
    }
    if (outside >= kMostPlaces) sheets.push_back(c);
  }

 private:
  bool is_outside(Vec3 place, Vec3 normal, DistanceSource::Hint& hint) const {
    // Far enough from the triangle that the side is certain.
    const double beside_m = 0.05 * finest_m_;
    return solid_.at(place + beside_m * normal, hint).distance_m > 0.5 * beside_m &&
           solid_.at(place - beside_m * normal, hint).distance_m > 0.5 * beside_m;
  }

  const DistanceSource& solid_;
  double finest_m_;
};

/// Triangles whose sides are moved by the same distance.
struct Layer {
  Layer(const Mesh& mesh, double by_m) : tree(mesh), added_m(by_m) {}
  TriangleTree tree;
  double added_m;
};

class ThickenedSource final : public DistanceSource {
 public:
  ThickenedSource(std::unique_ptr<DistanceSource> solid, std::vector<Layer> layers)
      : solid_(std::move(solid)), layers_(std::move(layers)) {}

  models::FieldSample at(Vec3 p, Hint& hint) const override {
    const models::FieldSample solid = solid_->at(p, hint);
    models::FieldSample least = solid;
    hint.of_parts.resize(layers_.size());
    for (std::size_t k = 0; k < layers_.size(); ++k) {
      const NearestTriangle near = nearest_in_ball(layers_[k].tree, p, hint.of_parts[k]);
      hint.of_parts[k].triangle = near.triangle;
      const models::FieldSample thick = thickened(solid, p - near.point_m, layers_[k].added_m);
      if (thick.distance_m < least.distance_m) least = thick;
    }
    return least;
  }
  void enter(Vec3 centre_m, double radius_m, Hint& hint) const override {
    solid_->enter(centre_m, radius_m, hint);
    hint.of_parts.resize(layers_.size());
    for (std::size_t k = 0; k < layers_.size(); ++k)
      enter_ball(layers_[k].tree, centre_m, radius_m, hint.of_parts[k]);
  }
  void leave(Hint& hint) const override {
    solid_->leave(hint);
    for (Hint& part : hint.of_parts) leave_ball(part);
  }
  Box bounds() const override {
    Box box = solid_->bounds();
    for (const Layer& layer : layers_) {
      const Vec3 by{layer.added_m, layer.added_m, layer.added_m};
      const Box own = layer.tree.bounds();
      box.grow(own.least_m - by);
      box.grow(own.most_m + by);
    }
    return box;
  }

 private:
  /// Outside: the distance to the layer minus the added thickness. Inside: deeper by the added thickness
  /// near the layer, decreasing to 0 where other surfaces are nearer by that much, so that the distance is
  /// continuous.
  static models::FieldSample thickened(const models::FieldSample& solid, Vec3 way, double added_m) {
    const double layer_m = norm(way);
    const Vec3 from_layer = layer_m > 0.0 ? way / layer_m : solid.gradient;
    if (solid.distance_m >= 0.0) return {layer_m - added_m, from_layer};
    const double more_m = added_m - (layer_m + solid.distance_m);
    if (more_m <= 0.0) return solid;
    if (more_m >= added_m) return {solid.distance_m - added_m, solid.gradient};
    return {solid.distance_m - more_m, unit(from_layer + 2.0 * solid.gradient)};
  }

  std::unique_ptr<DistanceSource> solid_;
  std::vector<Layer> layers_;
};

void add_triangle(Mesh& mesh, const std::array<Vec3, 3>& c) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.insert(mesh.vertices_m.end(), c.begin(), c.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

/// The step of each triangle, kSteps where it is not thin; 0 is a sheet without thickness.
template <class StepOf>
std::vector<int> steps_of(std::size_t count, const Work& work, const StepOf& step_of) {
  std::vector<int> steps(count, kSteps);
  constexpr int kGrain = 512;
  parallel_for(work, static_cast<int>(count), kGrain, [&](int begin, int end) {
    DistanceSource::Hint hint;
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end) && !work.cancelled();
         ++t)
      steps[t] = step_of(t, hint);
  });
  return steps;
}

}  // namespace

std::vector<Parameter> parameters_of(WallOptions& o) {
  return {{"least_cells", &o.least_cells, {0.0, 8.0}, "cells", "least thickness of a wall"}};
}

ThickenedWalls thickened_walls(std::unique_ptr<DistanceSource>& solid, const Mesh& surface,
                               const Mesh& sheets_from, std::size_t sheet_candidates, double finest_m,
                               const WallOptions& options, const Work& work) {
  PALPABLE_CHECK(check_ranges(options));
  ThickenedWalls walls;
  const double least_m = options.least_cells * finest_m;
  if (!(least_m > 0.0)) return walls;
  std::array<Mesh, kSteps> layers;
  const auto thin = steps_of(surface.triangles.size(), work, [&](std::size_t t, DistanceSource::Hint& hint) {
    const double thickness_m = thickness_behind(*solid, hint, corners_at(surface, t), least_m);
    return std::min(kSteps, static_cast<int>(kSteps * thickness_m / least_m));
  });
  for (std::size_t t = 0; t < thin.size(); ++t)
    if (thin[t] < kSteps)
      add_triangle(layers[static_cast<std::size_t>(thin[t])], corners_at(surface, t)), ++walls.thin;
  const SheetFinder finder(*solid, finest_m);
  std::vector<std::vector<std::array<Vec3, 3>>> sheets(sheet_candidates);
  constexpr int kGrain = 64;
  parallel_for(work, static_cast<int>(sheet_candidates), kGrain, [&](int begin, int end) {
    DistanceSource::Hint hint;
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end) && !work.cancelled();
         ++t)
      finder.add(corners_at(sheets_from, t), hint, sheets[t]);
  });
  for (const auto& parts : sheets) {
    for (const auto& part : parts) add_triangle(layers[0], part);
    walls.sheets += parts.empty() ? 0 : 1;
  }
  std::vector<Layer> made;
  for (int k = 0; k < kSteps; ++k) {
    const Mesh& mesh = layers[static_cast<std::size_t>(k)];
    if (mesh.triangles.empty()) continue;
    made.emplace_back(mesh, 0.5 * least_m * (1.0 - static_cast<double>(k) / kSteps));
    walls.added_m = std::max(walls.added_m, made.back().added_m);
  }
  if (!made.empty()) walls.distance = std::make_unique<ThickenedSource>(std::move(solid), std::move(made));
  return walls;
}

}  // namespace palpable::sculpt
