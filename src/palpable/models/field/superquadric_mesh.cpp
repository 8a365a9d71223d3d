// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/superquadric_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace palpable::models {
namespace {

constexpr int kMostDivisions = 700;

/// Grid points on the box of half axes 1, with indices shared along its edges.
class BoxGrid {
 public:
  explicit BoxGrid(std::array<int, 3> divisions) : n_(divisions) {}

  struct Quads {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> quads;
  };

  Quads quads() {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, n_[axis]}) face(axis, side);
    return {std::move(points_), std::move(quads_)};
  }

 private:
  std::uint32_t at(std::array<int, 3> c) {
    const auto key = (static_cast<std::uint64_t>(c[0]) << 40U) | (static_cast<std::uint64_t>(c[1]) << 20U) |
                     static_cast<std::uint64_t>(c[2]);
    const auto [found, added] = numbers_.try_emplace(key, static_cast<std::uint32_t>(points_.size()));
    if (added) {
      // The tangent spaces the grid more evenly on round shapes and keeps a box's edges.
      const auto spread = [&](std::size_t i) {
        return std::tan(0.25 * 3.14159265358979 * (2.0 * c[i] / n_[i] - 1.0));
      };
      points_.push_back({spread(0), spread(1), spread(2)});
    }
    return found->second;
  }

  void face(std::size_t axis, int side) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    std::array<int, 3> c{};
    c[axis] = side;
    const auto corner = [&](int i, int j) {
      c[u] = i;
      c[v] = j;
      return at(c);
    };
    for (int i = 0; i < n_[u]; ++i)
      for (int j = 0; j < n_[v]; ++j) {
        std::array<std::uint32_t, 4> q{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1),
                                       corner(i, j + 1)};
        if (side == 0) std::swap(q[1], q[3]);
        quads_.push_back(q);
      }
  }

  std::array<int, 3> n_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
  std::vector<Vec3> points_;
  std::vector<std::array<std::uint32_t, 4>> quads_;
};

int divisions(double half_axis_m, double spacing_m) {
  return static_cast<int>(std::clamp(std::ceil(2.0 * half_axis_m / spacing_m), 2.0, double{kMostDivisions}));
}

BoxGrid::Quads box_grid(const Superquadric& shape, double spacing_m) {
  return BoxGrid({divisions(shape.size_m.x, spacing_m), divisions(shape.size_m.y, spacing_m),
                  divisions(shape.size_m.z, spacing_m)})
      .quads();
}

Vec3 scaled(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

}  // namespace

Vec3 surface_normal(const Superquadric& shape, Vec3 p) noexcept {
  Vec3 normal;
  gauge(shape, p, normal);
  if (shape.deformed()) {
    // Normals are transformed by the cofactors of the Jacobian.
    const DeformedPoint d = deform_with_jacobian(shape, p);
    normal = normal.x * cross(d.by_y, d.by_z) + normal.y * cross(d.by_z, d.by_x) +
             normal.z * cross(d.by_x, d.by_y);
  }
  return unit(normal);
}

Mesh mesh_of(const Superquadric& shape, double spacing_m) {
  const BoxGrid::Quads grid = box_grid(shape, spacing_m);
  Mesh mesh;
  mesh.vertices_m.reserve(grid.points.size());
  for (const Vec3 p : grid.points) {
    const Vec3 place = deform(shape, on_surface(shape, scaled(p, shape.size_m)));
    mesh.vertices_m.push_back((shape.scene_from_shape * Point<ShapeFrame>{place}).v);
  }
  mesh.triangles.reserve(2 * grid.quads.size());
  for (const auto& q : grid.quads) {
    // Split along the shorter diagonal: better triangles at edges.
    const auto length = [&](std::size_t a, std::size_t b) {
      return squared_norm(mesh.vertices_m[q[a]] - mesh.vertices_m[q[b]]);
    };
    if (length(0, 2) <= length(1, 3)) {
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    } else {
      mesh.triangles.push_back({q[0], q[1], q[3]});
      mesh.triangles.push_back({q[1], q[2], q[3]});
    }
  }
  return mesh;
}

}  // namespace palpable::models
