// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace palpable::sculpt {

/// The smooth solid that a closed mesh's triangles approximate. Over each triangle the normals at its corners
/// are interpolated, and the surface is bent half way to the corners' tangent planes (Phong tessellation,
/// Boubekeur & Alexa 2008; one half is exact for a sphere to the second order). The distance of a point is
/// measured along the interpolated normal through it, so it has no facets, and a field of it needs far fewer
/// cells. Edges that turn by over 20 degrees stay sharp; where interpolated normals cross (near a centre of
/// curvature), the distance is that of the triangles. Vertices may move. Queries: any thread, none while
/// vertices move.
class SmoothSurface final : public DistanceSource {
 public:
  /// Which facets are smoothed; all of them by default.
  struct Rounding {
    /// Greatest distance of the smooth surface from the facets: edges that would need more stay sharp.
    double most_m = std::numeric_limits<double>::infinity();
    /// Edges of facets with a larger inscribed circle stay sharp, however small their angle.
    double largest_facet_m = std::numeric_limits<double>::infinity();
    /// The share of a facet's rise and turn that a field may omit (DistanceSource::Hint). A uniformly curved
    /// surface rises above the facet's centre by a quarter of it, and measured corners may have errors of
    /// that size.
    double coarse_share = 0.25;
    /// The same for a scan's noise, measured by the scatter of the vertex normals around the mean of their
    /// neighbours: that angle, and that angle times the facet's size. A tessellated smooth surface has none.
    /// Measured once, when the surface is made.
    double noise_turn_share = 0.0, noise_rise_share = 0.0;
  };
  /// A mesh that is_watertight().
  explicit SmoothSurface(Mesh mesh) : SmoothSurface(std::move(mesh), Rounding{}) {}
  SmoothSurface(Mesh mesh, const Rounding& rounding);

  /// Number of smoothed facets.
  std::size_t rounded_facets() const;

  struct Move {
    std::uint32_t vertex = 0;
    Vec3 to_m;
  };
  /// Moves vertices; updates only the triangles around them.
  void move(std::span<const Move> moves);

  models::DistanceSample at(Vec3 place_m, Hint& hint) const override;
  void enter(Vec3 centre_m, double radius_m, Hint& hint) const override;
  void leave(Hint& hint) const override;
  /// The bounding box of the triangles.
  Box bounds() const override { return tree_.bounds(); }
  /// A triangle's corners with their normals.
  struct Patch;

 private:
  Patch patch_of(std::uint32_t triangle) const;
  std::span<const std::uint32_t> fan(std::uint32_t vertex) const {
    return {fans_.data() + fan_begin_[vertex], fan_begin_[vertex + 1] - fan_begin_[vertex]};
  }
  void find_neighbours();
  void set_face(std::uint32_t triangle);
  void set_edges(std::uint32_t triangle);
  void set_normals(std::uint32_t vertex);
  void measure_noise();
  double normal_scatter2(std::uint32_t vertex) const;
  /// Whether the surface is smooth across a triangle's edge.
  bool is_smooth(std::uint32_t triangle, std::size_t side) const {
    return (smooth_[triangle] >> side & 1U) != 0;
  }
  Vec3 pseudo_normal(const NearestTriangle& near) const;
  models::DistanceSample faceted(Vec3 p, const NearestTriangle& near, const Hint& hint) const;
  std::optional<models::DistanceSample> projected(Vec3 p, const NearestTriangle& near,
                                                  double faceted_m) const;

  Rounding rounding_;
  Mesh mesh_;
  TriangleTree tree_;
  std::vector<Vec3> faces_;
  /// The normal at each corner of each triangle, of the smooth part of the surface there.
  std::vector<std::array<Vec3, 3>> normals_;
  /// The triangle across each edge: 0-1, 1-2, 2-0.
  std::vector<std::array<std::uint32_t, 3>> across_;
  /// Bit mask of the smooth edges.
  std::vector<std::uint8_t> smooth_;
  /// For each triangle: the scatter of the normals around it, radians, and that times the triangle's size.
  struct Noise {
    float turn = 0.0F, rise_m = 0.0F;
  };
  std::vector<Noise> noise_;
  /// For each vertex, the sum of the normals of the adjacent faces, weighted by their angles.
  std::vector<Vec3> around_;
  /// The corners at each vertex, as 3 triangle + corner; vertex v's from fan_begin_[v].
  std::vector<std::uint32_t> fan_begin_, fans_;
};

}  // namespace palpable::sculpt
