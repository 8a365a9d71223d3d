// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/thin_walls.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/numbers/disjoint_sets.hpp"
#include "palpable/sculpt/solid/nearest_in_balls.hpp"
#include "palpable/sculpt/triangles/mesh_edges.hpp"
#include "palpable/sculpt/triangles/open_sheets.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace palpable::sculpt {
namespace {

/// The centre of a triangle and a point near each of its corners.
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

/// Number of sample points of a triangle.
constexpr int kPlaces = 4;

/// The wall's thickness behind a triangle, at most `least_m`. At half of that depth inside a thicker wall,
/// this face is the nearest one; inside a thin wall it is the opposite face, or the point is outside.
double thickness_behind(const DistanceSource& solid, DistanceSource::Hint& hint, const std::array<Vec3, 3>& c,
                        double least_m, const WallOptions& options) {
  const Vec3 normal = unit(cross(c[1] - c[0], c[2] - c[0]));
  const double depth_m = 0.5 * least_m;
  int thin = 0, left = kPlaces;
  double sum_m = 0.0;
  for (const Vec3 place : places_of(c)) {
    // Most walls are thick, so usually two points decide.
    if (thin + left-- < options.least_points) return least_m;
    const models::DistanceSample there = solid.at(place - depth_m * normal, hint);
    if (dot(there.gradient, normal) > -options.opposite_cosine) continue;
    const double thickness_m = depth_m - there.distance_m;
    if (thickness_m > (1.0 - options.least_lack) * least_m || thickness_m < 0.0) continue;
    ++thin;
    sum_m += thickness_m;
  }
  return thin >= options.least_points ? sum_m / thin : least_m;
}

/// Finds the parts of triangles that have the solid on neither side.
class SheetFinder {
 public:
  SheetFinder(const DistanceSource& solid, double finest_m, const WallOptions& options)
      : solid_(solid),
        least_points_(options.least_points),
        finest_m_(finest_m),
        least_piece_m_(options.least_piece_cells * finest_m),
        most_piece_m_(std::max(options.least_piece_cells, options.most_piece_cells) * finest_m) {}

  /// Adds those parts of one triangle, which is divided if they differ.
  void add(const std::array<Vec3, 3>& c, DistanceSource::Hint& hint,
           std::vector<std::array<Vec3, 3>>& sheets) const {
    const double longest_m = std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
    const Vec3 normal = unit(cross(c[1] - c[0], c[2] - c[0]));
    int outside = 0;
    for (const Vec3 place : places_of(c)) outside += is_outside(place, normal, hint) ? 1 : 0;
    const bool is_mixed = outside > 0 && outside < kPlaces;
    // Large triangles may contain parts of both kinds between their sample points.
    if (longest_m > (is_mixed ? least_piece_m_ : most_piece_m_)) {
      const Vec3 a = 0.5 * (c[0] + c[1]), b = 0.5 * (c[1] + c[2]), d = 0.5 * (c[2] + c[0]);
      for (const auto& part : {std::array{c[0], a, d}, {a, c[1], b}, {d, b, c[2]}, {a, b, d}})
        add(part, hint, sheets);
      return;
    }
    if (outside >= least_points_) sheets.push_back(c);
  }

 private:
  bool is_outside(Vec3 place, Vec3 normal, DistanceSource::Hint& hint) const {
    // Far enough from the triangle that the side is certain.
    const double beside_m = 0.05 * finest_m_;
    return solid_.at(place + beside_m * normal, hint).distance_m > 0.5 * beside_m &&
           solid_.at(place - beside_m * normal, hint).distance_m > 0.5 * beside_m;
  }

  const DistanceSource& solid_;
  int least_points_;
  double finest_m_, least_piece_m_, most_piece_m_;
};

/// Triangles whose sides are moved by the same distance.
struct Layer {
  Layer(const Mesh& mesh, double by_m, bool sheets) : tree(mesh), added_m(by_m), is_sheets(sheets) {}
  TriangleTree tree;
  double added_m;
  /// Whether the triangles are outside the solid; otherwise they are part of its surface.
  bool is_sheets;
};

/// The union of the solid and the points within `added_m` of each layer. Where a layer is part of the
/// surface, the surface moves outwards by that distance. Planes stay planes, so that a field needs few cells.
class ThickenedSource final : public DistanceSource {
 public:
  /// `rest`: the solid's surface without the layers.
  ThickenedSource(std::unique_ptr<DistanceSource> solid, std::vector<Layer> layers, const Mesh& rest)
      : solid_(std::move(solid)), layers_(std::move(layers)) {
    if (!rest.triangles.empty()) rest_.emplace(rest);
  }

  models::DistanceSample at(Vec3 p, Hint& hint) const override {
    models::DistanceSample solid = solid_->at(p, hint);
    hint.of_parts.resize(layers_.size() + 1);
    constexpr double kFar_m = std::numeric_limits<double>::infinity();
    models::DistanceSample joined{kFar_m, {}}, under{-kFar_m, {}};
    double surface_m = kFar_m;
    for (std::size_t k = 0; k < layers_.size(); ++k) {
      const Layer& layer = layers_[k];
      const NearestTriangle near = nearest_in_ball(layer.tree, p, hint.of_parts[k]);
      hint.of_parts[k].triangle = near.triangle;
      const Vec3 way = p - near.point_m;
      const double layer_m = norm(way);
      const Vec3 away = layer_m > 0.0 ? way / layer_m : solid.gradient;
      if (layer_m - layer.added_m < joined.distance_m) joined = {layer_m - layer.added_m, away};
      if (layer.is_sheets) continue;
      surface_m = std::min(surface_m, layer_m);
      if (-layer_m - layer.added_m > under.distance_m)
        under = {-layer_m - layer.added_m, layer_m > 0.0 ? -1.0 * away : solid.gradient};
    }
    // The nearest triangle is accurate to a few parts in ten thousand.
    if (solid.distance_m < 0.0 && surface_m <= -1.001 * solid.distance_m)
      solid = below_layers(p, surface_m, solid, under, hint.of_parts.back());
    return joined.distance_m < solid.distance_m ? joined : solid;
  }
  void enter(Vec3 centre_m, double radius_m, Hint& hint) const override {
    solid_->enter(centre_m, radius_m, hint);
    hint.of_parts.resize(layers_.size() + 1);
    for (std::size_t k = 0; k < layers_.size(); ++k)
      enter_ball(layers_[k].tree, centre_m, radius_m, hint.of_parts[k]);
  }
  void leave(Hint& hint) const override {
    solid_->leave(hint);
    for (std::size_t k = 0; k < layers_.size(); ++k) leave_ball(hint.of_parts[k]);
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
  /// Inside the solid, near a layer of its surface at distance `surface_m`: `under` is the distance to the
  /// moved layers; the rest of the surface may be nearer.
  models::DistanceSample below_layers(Vec3 p, double surface_m, const models::DistanceSample& solid,
                                      const models::DistanceSample& under, Hint& hint) const {
    if (!rest_) return under;
    const NearestTriangle near = nearest_in_ball(*rest_, p, hint);
    hint.triangle = near.triangle;
    const double rest_m = std::sqrt(near.squared_distance_m2);
    if (rest_m < surface_m) return solid;
    return -rest_m > under.distance_m ? models::DistanceSample{-rest_m, (near.point_m - p) / rest_m} : under;
  }

  std::unique_ptr<DistanceSource> solid_;
  std::vector<Layer> layers_;
  std::optional<TriangleTree> rest_;
};

void add_triangle(Mesh& mesh, const std::array<Vec3, 3>& c) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.insert(mesh.vertices_m.end(), c.begin(), c.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

/// The thickness step of each triangle; `steps_count` if it is not thin, 0 for a sheet without thickness.
template <class StepOf>
std::vector<int> steps_of(std::size_t count, int steps_count, const Work& work, const StepOf& step_of) {
  std::vector<int> steps(count, steps_count);
  constexpr int kGrain = 512;
  parallel_for(work, static_cast<int>(count), kGrain, [&](int begin, int end) {
    DistanceSource::Hint hint;
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end) && !work.cancelled();
         ++t)
      steps[t] = step_of(t, hint);
  });
  return steps;
}

/// Triangles that share vertices, as one sheet.
struct SheetPatch {
  Box box;
  Vec3 area_m2;
  double size_m2 = 0.0;

  void add(const std::array<Vec3, 3>& c) {
    const Vec3 doubled = cross(c[1] - c[0], c[2] - c[0]);
    // Sheets need not be oriented.
    area_m2 += dot(doubled, area_m2) < 0.0 ? -0.5 * doubled : 0.5 * doubled;
    size_m2 += 0.5 * norm(doubled);
    for (const Vec3 corner : c) box.grow(corner);
  }
  /// Whether it is the ground of a solid such as a city: it faces up, lies at the solid's foot or lower, and
  /// extends beyond it.
  bool is_ground(const Box& solid, const WallOptions& options) const {
    if (std::abs(dot(area_m2, options.up)) < options.ground_facing * size_m2) return false;
    const auto along = [](Vec3 v) { return std::array{v.x, v.y, v.z}; };
    const auto up = along(options.up), least = along(solid.least_m - box.least_m),
               most = along(box.most_m - solid.most_m), size = along(solid.size_m());
    const Vec3 solid_middle = 0.5 * (solid.least_m + solid.most_m), middle = 0.5 * (box.least_m + box.most_m);
    double beyond_m = 0.0, height_m = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (up[axis] != 0.0) {
        height_m = size[axis];
        continue;
      }
      if (least[axis] < 0.0 || most[axis] < 0.0) return false;
      beyond_m = std::max({beyond_m, least[axis], most[axis]});
    }
    return dot(middle - solid_middle, options.up) <= (options.ground_height - 0.5) * height_m &&
           beyond_m > options.ground_beyond * *std::max_element(size.begin(), size.end());
  }
};

/// For each triangle, the first one of those connected to it by vertices; only `wanted` ones count.
std::vector<std::uint32_t> connected(const Mesh& mesh, const std::vector<char>& wanted) {
  DisjointSets sets(mesh.triangles.size());
  std::vector<std::uint32_t> at_vertex(mesh.vertices_m.size(), OpenSheets::kNone);
  for (std::uint32_t t = 0; t < wanted.size(); ++t) {
    if (wanted[t] == 0) continue;
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (at_vertex[v] == OpenSheets::kNone) at_vertex[v] = t;
      sets.join(at_vertex[v], t);
    }
  }
  return sets.firsts();
}

/// Which triangles of `wanted` belong to patches that are ground.
std::vector<char> ground_among(const Mesh& mesh, const std::vector<char>& wanted, const Box& solid,
                               const WallOptions& options) {
  const std::vector<std::uint32_t> first = connected(mesh, wanted);
  std::map<std::uint32_t, SheetPatch> patches;
  for (std::uint32_t t = 0; t < wanted.size(); ++t) {
    if (wanted[t] == 0) continue;
    const auto corners = corners_at(mesh, t);
    patches.try_emplace(first[t], SheetPatch{bounds_of(std::span(corners)), {}, 0.0})
        .first->second.add(corners);
  }
  std::vector<char> ground(wanted.size());
  for (std::uint32_t t = 0; t < wanted.size(); ++t)
    ground[t] = wanted[t] != 0 && patches.at(first[t]).is_ground(solid, options);
  return ground;
}

/// The parts of the candidates that lie outside the solid, without the ground.
Mesh sheets_outside(const DistanceSource& solid, const SheetCandidates& candidates, bool has_ground,
                    double finest_m, const WallOptions& options, const Work& work, ThickenedWalls& walls) {
  const SheetFinder finder(solid, finest_m, options);
  const Mesh& mesh = candidates.mesh;
  const std::size_t count = mesh.triangles.size();
  std::vector<std::vector<std::array<Vec3, 3>>> found(count);
  constexpr int kGrain = 64;
  parallel_for(work, static_cast<int>(count), kGrain, [&](int begin, int end) {
    DistanceSource::Hint hint;
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end) && !work.cancelled();
         ++t)
      finder.add(corners_at(mesh, t), hint, found[t]);
  });
  std::vector<char> is_sheet(count), is_ground(count);
  for (std::size_t t = 0; t < count; ++t) is_sheet[t] = !found[t].empty();
  if (has_ground) is_ground = ground_among(mesh, is_sheet, solid.bounds(), options);
  Mesh sheets;
  std::set<std::uint32_t> open_sheets;
  for (std::size_t t = 0; t < count; ++t) {
    if (is_sheet[t] == 0) continue;
    ++(is_ground[t] != 0 ? walls.ground : walls.sheets);
    if (is_ground[t] != 0) continue;
    for (const auto& part : found[t]) add_triangle(sheets, part);
    if (candidates.open_sheet[t] == OpenSheets::kNone) continue;
    ++walls.open_sheet_triangles;
    open_sheets.insert(candidates.open_sheet[t]);
  }
  walls.open_sheets = open_sheets.size();
  return sheets;
}

/// All places are outside and far from it.
class NoSolid final : public DistanceSource {
 public:
  models::DistanceSample at(Vec3, Hint&) const override { return {kEverywhere_m, {0.0, 0.0, 1.0}}; }
  Box bounds() const override {
    return {{kEverywhere_m, kEverywhere_m, kEverywhere_m}, {-kEverywhere_m, -kEverywhere_m, -kEverywhere_m}};
  }

 private:
  static constexpr double kEverywhere_m = std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<Parameter> parameters_of(WallOptions& o) {
  return {
      {"least_cells", &o.least_cells, {0.0, 8.0}, "cells", "least thickness of a wall"},
      {"ground_height",
       &o.ground_height,
       {0.0, 1.0},
       "",
       "lowest share of the solid's height in which ground lies"},
      {"ground_facing",
       &o.ground_facing,
       {0.5, 1.0},
       "",
       "share of a sheet that faces up or down if it is ground"},
      {"ground_beyond",
       &o.ground_beyond,
       {0.0, 1.0},
       "",
       "how far ground extends beyond the solid, as a share of its side"},
      {"opposite_cosine",
       &o.opposite_cosine,
       {0.0, 1.0},
       "",
       "cosine of the angle from which two faces form a wall"},
      {"least_points", &o.least_points, {1.0, 4.0}, "", "points of a triangle that must be on a thin wall"},
      {"thickness_steps", &o.thickness_steps, {1.0, 16.0}, "", "number of different added thicknesses"},
      {"least_lack", &o.least_lack, {0.0, 1.0}, "", "share of the least thickness that may be missing"},
      {"least_piece_cells",
       &o.least_piece_cells,
       {0.1, 1000.0},
       "cells",
       "smallest pieces into which a sheet is divided"},
      {"most_piece_cells",
       &o.most_piece_cells,
       {0.1, 1000.0},
       "cells",
       "largest pieces of a sheet that are not divided"}};
}

ThickenedWalls thickened_walls(std::unique_ptr<DistanceSource>& solid, const Mesh& surface,
                               const SheetCandidates& candidates, double finest_m, const WallOptions& options,
                               const Work& work) {
  PALPABLE_CHECK(check_ranges(options));
  ThickenedWalls walls;
  const double least_m = options.least_cells * finest_m;
  if (!(least_m > 0.0)) return walls;
  const bool has_solid = solid != nullptr;
  if (!has_solid) solid = std::make_unique<NoSolid>();
  const int most_steps = options.thickness_steps;
  std::vector<Mesh> layers(static_cast<std::size_t>(most_steps));
  Mesh rest;
  const auto thin =
      steps_of(surface.triangles.size(), most_steps, work, [&](std::size_t t, DistanceSource::Hint& hint) {
        const double thickness_m = thickness_behind(*solid, hint, corners_at(surface, t), least_m, options);
        return std::min(most_steps, static_cast<int>(most_steps * thickness_m / least_m));
      });
  for (std::size_t t = 0; t < thin.size(); ++t) {
    const bool is_thin = thin[t] < most_steps;
    add_triangle(is_thin ? layers[static_cast<std::size_t>(thin[t])] : rest, corners_at(surface, t));
    walls.thin += is_thin ? 1 : 0;
  }
  const Mesh sheets = sheets_outside(*solid, candidates, has_solid, finest_m, options, work, walls);
  std::vector<Layer> made;
  const auto add_layer = [&](const Mesh& mesh, double by_m, bool is_sheets) {
    if (mesh.triangles.empty()) return;
    made.emplace_back(mesh, by_m, is_sheets);
    walls.added_m = std::max(walls.added_m, by_m);
  };
  for (int k = 0; k < most_steps; ++k)
    add_layer(layers[static_cast<std::size_t>(k)],
              0.5 * least_m * (1.0 - static_cast<double>(k) / most_steps), false);
  add_layer(sheets, 0.5 * least_m, true);
  if (!made.empty())
    walls.distance = std::make_unique<ThickenedSource>(std::move(solid), std::move(made), rest);
  return walls;
}

}  // namespace palpable::sculpt
