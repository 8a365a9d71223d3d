// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/mesh_surface_check.hpp"

#include "palpable/core/text/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

using Corners = std::array<Vec3, 3>;

/// A triangle's longest side, and its height above that.
struct Shape {
  double side = 0.0;
  double height = 0.0;
};

Shape shape_of(const Corners& c) {
  const double side = std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
  return {side, side > 0.0 ? norm(cross(c[1] - c[0], c[2] - c[0])) / side : 0.0};
}

/// What the coordinates of corners can tell apart.
struct Rounding {
  double farthest = 0.0;
  bool is_single = true;

  double step() const {
    return farthest * (is_single ? static_cast<double>(std::numeric_limits<float>::epsilon())
                                 : std::numeric_limits<double>::epsilon());
  }
};

/// Calls visit(corners) for each triangle whose corners exist and are finite.
template <class Visit>
void each_triangle(const Mesh& mesh, const Visit& visit) {
  for (const auto& t : mesh.triangles) {
    if (std::max({t[0], t[1], t[2]}) >= mesh.vertices_m.size()) continue;
    const Corners corners{mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
    if (std::all_of(corners.begin(), corners.end(), [](Vec3 v) { return is_finite(v); })) visit(corners);
  }
}

Rounding rounding_of(const Mesh& mesh) {
  Rounding rounding;
  each_triangle(mesh, [&rounding](const Corners& corners) {
    for (const Vec3& v : corners)
      for (const double coordinate : {v.x, v.y, v.z}) {
        rounding.farthest = std::max(rounding.farthest, std::abs(coordinate));
        rounding.is_single =
            rounding.is_single && static_cast<double>(static_cast<float>(coordinate)) == coordinate;
      }
  });
  return rounding;
}

}  // namespace

double coordinate_step(const Mesh& mesh) { return rounding_of(mesh).step(); }

Result<void> check_surface(const Mesh& mesh) {
  // Of a height of a few rounding steps, or of this part of the triangle's side, nothing is known.
  constexpr double kSteps = 4.0, kThinnest = 1e-7;
  const Rounding rounding = rounding_of(mesh);
  std::optional<Vec3> first;
  double longest = 0.0, highest = 0.0;
  each_triangle(mesh, [&](const Corners& corners) {
    if (!first) first = corners[0];
    for (const Vec3& v : corners) longest = std::max(longest, norm(v - *first));
    const Shape shape = shape_of(corners);
    if (shape.height > kThinnest * shape.side) highest = std::max(highest, shape.height);
  });
  if (!first || highest > kSteps * rounding.step()) return {};
  std::string why = "is a mesh without surface: ";
  why += !(longest > 0.0) ? "all its corners are at one place"
         : highest > 0.0  ? "the corners of each triangle are on one line, as far as its coordinates tell"
                          : "the corners of each triangle are on one line";
  // From this distance on, in comparison with the mesh, or without a size to compare, it may be the reason.
  constexpr double kFar = 1e3;
  if (rounding.farthest > kFar * (longest > 0.0 ? longest : 1.0))
    why += fmt::format("; {} from its origin its coordinates have steps of {}: move it to its origin",
                       figure(rounding.farthest), figure(rounding.step()));
  return invalid_input(std::move(why));
}

}  // namespace palpable::recipes
