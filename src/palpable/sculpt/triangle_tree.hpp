// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/sculpt/box.hpp"

#include <array>
#include <cstdint>
#include <span>
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

  /// Whether the triangle comes within `radius_m` of `p`.
  bool reaches(std::uint32_t triangle, Vec3 p, double radius_m) const;

  /// Calls visit(index) for every triangle whose own box meets this one.
  template <class Visit>
  void visit_box(Vec3 least_m, Vec3 most_m, Visit&& visit) const {
    visit_box(0, least_m, most_m, visit);
  }

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

  static bool meet(Vec3 low, Vec3 high, Vec3 other_low, Vec3 other_high) {
    return low.x <= other_high.x && low.y <= other_high.y && low.z <= other_high.z && high.x >= other_low.x &&
           high.y >= other_low.y && high.z >= other_low.z;
  }
  template <class Visit>
  void visit_box(std::uint32_t at, Vec3 low, Vec3 high, Visit& visit) const {
    const Node& node = nodes_[at];
    if (!meet(low, high, node.low, node.high)) return;
    if (node.right != 0) {
      visit_box(at + 1, low, high, visit);
      visit_box(node.right, low, high, visit);
      return;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Box box = bounds_of(std::span<const Vec3>(corners_[i]));
      if (meet(low, high, box.least_m, box.most_m)) visit(order_[i]);
    }
  }

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
