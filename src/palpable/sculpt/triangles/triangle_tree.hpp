// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/sculpt/triangles/box.hpp"
#include "palpable/sculpt/triangles/four_boxes.hpp"
#include "palpable/sculpt/triangles/four_dipoles.hpp"
#include "palpable/sculpt/triangles/four_triangles.hpp"
#include "palpable/sculpt/triangles/triangle_shortlist.hpp"

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

/// A bounding-volume tree over a mesh's triangles (at least one, all corners finite). Queries: any thread.
class TriangleTree {
 public:
  explicit TriangleTree(const Mesh& mesh);

  /// Updates the boxes above these triangles after their vertices have moved. The tree's structure does not
  /// change, so large movements make it slower, but never wrong. No query at the same time.
  void move(const Mesh& mesh, std::span<const std::uint32_t> triangles);

  Box bounds() const { return {nodes_[0].low, nodes_[0].high}; }

  static constexpr double kNearestSlack = 3e-4;

  /// Relative error of the distance: kNearestSlack. The point is on the surface. `guess`: a triangle that
  /// may be near (any valid index); it only saves time.
  NearestTriangle nearest(Vec3 p, std::uint32_t guess) const;

  /// The same for a point of the ball that the list was made for.
  NearestTriangle nearest(Vec3 p, std::uint32_t guess, const TriangleShortlist& among) const;

  /// The triangles that may be nearest to points of a ball. `within`: the list of a larger ball around it,
  /// or null.
  void list_near(Vec3 centre, double radius_m, std::uint32_t guess, const TriangleShortlist* within,
                 TriangleShortlist& list) const;

  /// Whether a triangle other than `except` comes within `radius_m` of `p`.
  bool any_within(Vec3 p, double radius_m, std::uint32_t except) const;

  /// Calls visit(index) for every triangle whose own box meets this one.
  template <class Visit>
  void visit_box(Vec3 least_m, Vec3 most_m, Visit&& visit) const {
    visit_box(0, least_m, most_m, visit);
  }

  /// The winding number of `p`: about 1 inside a closed mesh whose triangles face outwards, 0 outside,
  /// fractions near holes (Jacobson et al. 2013). Far groups of triangles are approximated as dipoles
  /// (Barill et al. 2018), with an error of about 0.01.
  double winding(Vec3 p) const;

  /// Number of triangles that a ray from `p` crosses.
  int crossings(Vec3 p, Vec3 direction) const;

  /// How far a ray from `p` reaches until it meets a triangle, in lengths of `direction`; infinite if it
  /// meets none.
  double first_hit(Vec3 p, Vec3 direction) const;

 private:
  struct Node {
    Vec3 low, high;
    /// Inner: the left child follows its parent, `right` is the other; a leaf: right == 0.
    std::uint32_t right = 0;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    /// Index of a leaf's triangles in leaves_.
    std::uint32_t leaf = 0;
  };
  /// A node's triangles as seen from afar: summed area vectors, their centre, and the radius around it.
  struct Dipole {
    Vec3 area_m2;
    Vec3 centre_m;
    double radius_m = 0.0;
    /// The triangles' own areas, summed.
    double size_m2 = 0.0;
  };
  using Corners = std::array<Vec3, 3>;
  /// Greater than the depth of any balanced tree of 2^32 triangles.
  static constexpr std::size_t kStack = 80;

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

  static constexpr double kShare = (1.0 - kNearestSlack) * (1.0 - kNearestSlack);
  std::array<float, 3> from_origin(Vec3 p) const {
    const Vec3 v = p - origin_m_;
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  }
  NearestTriangle measured(Vec3 p, std::uint32_t place) const;
  /// `place`: p relative to the origin.
  void try_leaf(Vec3 p, const std::array<float, 3>& place, std::uint32_t node, NearestTriangle& best) const;
  std::uint32_t build(std::uint32_t first, std::uint32_t count, const std::vector<Vec3>& centres);
  /// Box and dipole of a node whose children have theirs.
  void bound(std::uint32_t at);
  void bound_box(std::uint32_t at);
  void bound_dipole(std::uint32_t at);
  void set_leaf(std::uint32_t at);
  double rounding_m() const;
  /// Groups a node's grandchildren, and all nodes below them, in fours; returns the index of the first group.
  std::uint32_t gather(std::uint32_t at);
  void put_into_four(std::uint32_t at);
  /// A box of few triangles is aligned with their mean normal. On curved surfaces it is much tighter than an
  /// axis-aligned box, so a point that is nearly equidistant from everything (the middle of a sphere) takes
  /// less time.
  OrientedBox oriented_box(const Node& node, Vec3 area_m2) const;
  /// `places`: sorted indices into corners_, all belonging to the node.
  void bound_over(std::uint32_t at, std::span<const std::uint32_t> places);

  /// Solid angle of a leaf's triangles.
  double solid_angle(Vec3 p, const Node& leaf) const;

  /// Two levels of the tree combined, for nearest() and winding().
  struct Four {
    FourBoxes boxes;
    FourDipoles dipoles;
    /// Their nodes, and for an inner node the index of its own group.
    std::array<std::uint32_t, FourBoxes::kCount> node, below;
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  std::vector<Node> nodes_;
  std::vector<Dipole> dipoles_;
  std::vector<Four> fours_;
  std::vector<FourTriangles> leaves_;
  /// For each node its lane in fours_: 4 x which + lane, or kNone.
  std::vector<std::uint32_t> lane_of_;
  /// fours_ and leaves_ are relative to this point; their rounding error is at most rounding_m_.
  Vec3 origin_m_;
  double rounding_m_ = 0.0;
  /// In the order of the leaves; order_ maps to indices of the mesh, and place_ back.
  std::vector<Corners> corners_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> place_;
};

}  // namespace palpable::sculpt
