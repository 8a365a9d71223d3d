// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/mesh_distance.hpp"

#include "palpable/sculpt/solid/inside_test.hpp"
#include "palpable/sculpt/solid/nearest_in_balls.hpp"
#include "palpable/sculpt/solid/surface_cut.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

/// An edge of a mesh with all its triangles.
struct Edge {
  std::uint32_t from = 0, to = 0;
  /// Direction of the sum of its triangles' normals.
  Vec3 normal;
  /// Whether it has exactly two triangles, one on each side. This is false on rims, and where triangles end
  /// on the middle of another triangle's edge.
  bool closed = true;
};

/// A mesh's edges, and which of them each triangle has: 0-1, 1-2, 2-0.
struct Edges {
  std::vector<Edge> all;
  std::vector<std::array<std::uint32_t, 3>> of_triangle;
};

Edges edges_of(const Mesh& mesh, const std::vector<Vec3>& faces) {
  struct Use {
    std::uint64_t ends;
    std::uint32_t triangle;
    std::uint8_t side;
    bool upwards;
  };
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint64_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1U) % 3];
      uses.push_back({std::min(a, b) << 32U | std::max(a, b), t, k, a < b});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::pair(a.ends, a.triangle) < std::pair(b.ends, b.triangle);
  });
  Edges edges;
  edges.of_triangle.resize(mesh.triangles.size());
  for (std::size_t i = 0; i < uses.size();) {
    Edge edge{
        static_cast<std::uint32_t>(uses[i].ends >> 32U), static_cast<std::uint32_t>(uses[i].ends), {}, true};
    const std::size_t first = i;
    int balance = 0;
    for (; i < uses.size() && uses[i].ends == uses[first].ends; ++i) {
      edges.of_triangle[uses[i].triangle][uses[i].side] = static_cast<std::uint32_t>(edges.all.size());
      edge.normal += faces[uses[i].triangle];
      balance += uses[i].upwards ? 1 : -1;
    }
    edge.closed = i - first == 2 && balance == 0;
    edges.all.push_back(edge);
  }
  return edges;
}

std::vector<Vec3> face_normals(const Mesh& mesh) {
  std::vector<Vec3> faces;
  faces.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    faces.push_back(unit(cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a)));
  }
  return faces;
}

/// The normal that decides the sign for points nearest to each part of each triangle.
class Joints {
 public:
  explicit Joints(const Mesh& surface)
      : triangles_(surface.triangles),
        faces_(face_normals(surface)),
        edges_(edges_of(surface, faces_)),
        corners_(surface.vertices_m.size()) {
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto vertex = [&](std::size_t i) { return surface.vertices_m[triangles_[t][i % 3]]; };
        const Vec3 a = unit(vertex(k + 1) - vertex(k)), b = unit(vertex(k + 2) - vertex(k));
        corners_[triangles_[t][k]] += std::acos(std::clamp(dot(a, b), -1.0, 1.0)) * faces_[t];
      }
    all_closed_ = std::all_of(edges_.all.begin(), edges_.all.end(), [](const Edge& e) { return e.closed; });
  }

  /// Whether all edges are closed. If some are not, bodies were cut along each other or touch, and even an
  /// edge with two triangles may lie on the middle of a third.
  bool all_closed() const { return all_closed_; }
  Vec3 at(std::uint32_t triangle, TrianglePart part) const {
    if (part == TrianglePart::face) return faces_[triangle];
    if (part <= TrianglePart::edge_20) {
      const auto side = static_cast<std::size_t>(part) - static_cast<std::size_t>(TrianglePart::edge_01);
      const Edge& edge = edges_.all[edges_.of_triangle[triangle][side]];
      return edge.normal;
    }
    const auto corner = static_cast<std::size_t>(part) - static_cast<std::size_t>(TrianglePart::corner_0);
    return corners_[triangles_[triangle][corner]];
  }
  Vec3 face(std::uint32_t triangle) const { return faces_[triangle]; }

 private:
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Vec3> faces_;
  Edges edges_;
  std::vector<Vec3> corners_;
  bool all_closed_ = true;
};

class MeshDistance final : public DistanceSource {
 public:
  MeshDistance(const Mesh& surface, const Mesh& whole, std::vector<FacetTolerance> tolerances)
      : tree_(surface), joints_(surface), tolerances_(std::move(tolerances)), bounds_(bounds_of(surface)) {
    const Box box = bounds_of(whole);
    if (&surface != &whole) {
      whole_.emplace(whole);
      thinnest_m_ = kThinnestSolid * norm(box.most_m - box.least_m);
    }
    // Files use single precision: surfaces that touch may be apart by the last digit.
    touching_m_ = 2e-7 * norm(box.most_m - box.least_m);
    normals_valid_within_m_ = touching_m_ / TriangleTree::kNearestSlack;
  }

  models::DistanceSample at(Vec3 p, Hint& hint) const override {
    const NearestTriangle near = nearest_in_ball(tree_, p, hint);
    const models::DistanceSample sample = sample_at(p, near, hint);
    const FacetTolerance tolerance = tolerances_.empty() ? FacetTolerance{} : tolerances_[near.triangle];
    hint.coarse_m = static_cast<double>(tolerance.rise_m);
    hint.coarse_turn = static_cast<double>(tolerance.turn);
    remember(near, p, sample.distance_m, hint);
    return sample;
  }
  void enter(Vec3 centre_m, double radius_m, Hint& hint) const override {
    enter_ball(tree_, centre_m, radius_m, hint);
  }
  void leave(Hint& hint) const override { leave_ball(hint); }
  Box bounds() const override { return bounds_; }

 private:
  models::DistanceSample sample_at(Vec3 p, const NearestTriangle& near, const Hint& hint) const {
    const Vec3 way = p - near.point_m;
    const Vec3 there = joints_.at(near.triangle, near.part);
    const double distance = std::sqrt(near.squared_distance_m2);
    if (near.part == TrianglePart::face && distance <= normals_valid_within_m_)
      return {dot(way, there), there};
    if (distance <= touching_m_) return {0.0, joints_.face(near.triangle)};
    const bool by_normal = joints_.all_closed() && distance <= normals_valid_within_m_;
    const InsideTest solid{whole_ ? *whole_ : tree_, thinnest_m_};
    const bool inside =
        by_normal ? is_behind(solid, p, way, there, hint) : is_behind(solid, p, distance, hint);
    const double sign = inside ? -1.0 : 1.0;
    return {sign * distance, (sign / distance) * way};
  }

  TriangleTree tree_;
  Joints joints_;
  std::vector<FacetTolerance> tolerances_;
  /// The original mesh, if it differs from the surface.
  std::optional<TriangleTree> whole_;
  /// Only the original mesh may have parts that are not of the solid.
  double thinnest_m_ = 0.0;
  Box bounds_;
  double touching_m_ = 0.0;
  /// Beyond this distance the wrong side of a thin sheet may have been found as the nearest triangle, so the
  /// winding number decides the sign.
  double normals_valid_within_m_ = 0.0;
};

}  // namespace

std::unique_ptr<DistanceSource> mesh_distance(const Mesh& surface, const Mesh& whole,
                                              std::vector<FacetTolerance> tolerances) {
  return std::make_unique<MeshDistance>(surface, whole, std::move(tolerances));
}

}  // namespace palpable::sculpt
