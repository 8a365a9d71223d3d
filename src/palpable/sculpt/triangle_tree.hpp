// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// Where on a triangle a point is nearest.
enum class TrianglePart : std::uint8_t { face, edge_01, edge_12, edge_20, corner_0, corner_1, corner_2 };

/// The nearest point of a set of triangles.
struct NearestTriangle {
  Vec3 point_m;
  double squared_distance_m2 = 0.0;
  /// Index in the mesh.
  std::uint32_t triangle = 0;
  TrianglePart part = TrianglePart::face;
};

/// The point of one triangle nearest to `p` (Ericson 2005, 5.1.5).
NearestTriangle nearest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

/// A bounding-volume tree over a mesh's triangles (at least one, all corners finite). Immutable; any thread.
class TriangleTree {
 public:
  explicit TriangleTree(const Mesh& mesh);

  static constexpr double kNearestSlack = 3e-4;

  /// True to kNearestSlack of the distance: the point is on the surface, and none is nearer by more than
  /// that. `guess`: a triangle that may be near (any valid index); it only saves time.
  NearestTriangle nearest(Vec3 p, std::uint32_t guess) const;

  /// Whether a triangle other than `except` comes within `radius_m` of `p`.
  bool any_within(Vec3 p, double radius_m, std::uint32_t except) const;

  /// How often the triangles wind round `p`: about 1 inside a closed mesh whose triangles face outwards, 0
  /// outside; broken numbers near holes (Jacobson et al. 2013). Far groups of triangles count as dipoles
  /// (Barill et al. 2018): good to about 0.01.
  double winding(Vec3 p) const;

  /// How many triangles a ray from `p` meets.
  int crossings(Vec3 p, Vec3 direction) const;

 private:
  struct Node {
    Vec3 low, high;
    /// The triangles lie between two planes across their mean normal: on curved surfaces far tighter than the
    /// box, which lets a place that is nearly as far from everything (a sphere's middle) be answered.
    Vec3 normal;
    double slab_low = 0.0, slab_high = 0.0;
    /// Inner: the left child follows its parent, `right` is the other; a leaf: right == 0.
    std::uint32_t right = 0;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  /// A node's triangles as seen from afar: summed area vectors, their centre, and the radius around it.
  struct Dipole {
    Vec3 area_m2;
    Vec3 centre_m;
    double radius_m = 0.0;
  };
  using Corners = std::array<Vec3, 3>;

  static double squared_distance(Vec3 p, const Node& node);
  void add_slab(Node& node, const Dipole& dipole) const;
  std::uint32_t build(std::uint32_t first, std::uint32_t count, const std::vector<Vec3>& centres);
  Dipole dipole_of(std::uint32_t node) const;

  std::vector<Node> nodes_;
  std::vector<Dipole> dipoles_;
  /// In the order of the leaves; order_ gives their index in the mesh and place_ the way back.
  std::vector<Corners> corners_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> place_;
};

}  // namespace palpable::sculpt
