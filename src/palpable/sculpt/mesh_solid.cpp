// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/mesh_solid.hpp"

#include "palpable/sculpt/mesh_orientation.hpp"
#include "palpable/sculpt/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <unordered_map>
#include <utility>

namespace palpable::sculpt {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Box bounds_of(const Mesh& mesh) {
  Box box{mesh.vertices_m[mesh.triangles[0][0]], mesh.vertices_m[mesh.triangles[0][0]]};
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t index : t) {
      const Vec3 v = mesh.vertices_m[index];
      box.least_m = {std::min(box.least_m.x, v.x), std::min(box.least_m.y, v.y),
                     std::min(box.least_m.z, v.z)};
      box.most_m = {std::max(box.most_m.x, v.x), std::max(box.most_m.y, v.y), std::max(box.most_m.z, v.z)};
    }
  return box;
}

/// A normal for each part of each triangle that tells the side of every place nearest to it, on a closed mesh
/// (angle-weighted pseudo-normals: Baerentzen & Aanaes 2005).
class PseudoNormals {
 public:
  explicit PseudoNormals(const Mesh& mesh) : triangles_(mesh.triangles) {
    faces_.reserve(triangles_.size());
    corners_.resize(mesh.vertices_m.size());
    edges_.reserve(2 * triangles_.size());
    for (const Triangle& t : triangles_) {
      const std::array<Vec3, 3> v{mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
      const Vec3 n = unit(cross(v[1] - v[0], v[2] - v[0]));
      faces_.push_back(n);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = unit(v[(k + 1) % 3] - v[k]), b = unit(v[(k + 2) % 3] - v[k]);
        corners_[t[k]] += std::acos(std::clamp(dot(a, b), -1.0, 1.0)) * n;
        Edge& edge = edges_[key(t[k], t[(k + 1) % 3])];
        edge.normal += n;
        edge.balance += t[k] < t[(k + 1) % 3] ? 1 : -1;
        ++edge.users;
      }
    }
    rim_.resize(mesh.vertices_m.size());
    for (const auto& [ends, edge] : edges_)
      if (!edge.closed()) rim_[ends >> 32U] = rim_[ends & 0xFFFFFFFFU] = true;
  }

  /// Whether at() tells the side there: not on a rim, where the surface was cut or left open.
  bool tells_the_side(std::uint32_t triangle, TrianglePart part) const {
    const Triangle& t = triangles_[triangle];
    switch (part) {
      case TrianglePart::face:
        return true;
      case TrianglePart::edge_01:
        return edges_.at(key(t[0], t[1])).closed();
      case TrianglePart::edge_12:
        return edges_.at(key(t[1], t[2])).closed();
      case TrianglePart::edge_20:
        return edges_.at(key(t[2], t[0])).closed();
      case TrianglePart::corner_0:
        return !rim_[t[0]];
      case TrianglePart::corner_1:
        return !rim_[t[1]];
      case TrianglePart::corner_2:
        return !rim_[t[2]];
    }
    return false;
  }

  Vec3 face(std::uint32_t triangle) const { return faces_[triangle]; }
  Vec3 at(std::uint32_t triangle, TrianglePart part) const {
    const Triangle& t = triangles_[triangle];
    switch (part) {
      case TrianglePart::face:
        return faces_[triangle];
      case TrianglePart::edge_01:
        return edges_.at(key(t[0], t[1])).normal;
      case TrianglePart::edge_12:
        return edges_.at(key(t[1], t[2])).normal;
      case TrianglePart::edge_20:
        return edges_.at(key(t[2], t[0])).normal;
      case TrianglePart::corner_0:
        return corners_[t[0]];
      case TrianglePart::corner_1:
        return corners_[t[1]];
      case TrianglePart::corner_2:
        return corners_[t[2]];
    }
    return {};
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32U | std::max(a, b);
  }
  std::vector<Triangle> triangles_;
  std::vector<Vec3> faces_;
  std::vector<Vec3> corners_;
  struct Edge {
    Vec3 normal;
    int users = 0;
    int balance = 0;
    bool closed() const { return users == 2 && balance == 0; }
  };
  std::unordered_map<std::uint64_t, Edge> edges_;
  std::vector<bool> rim_;
};

/// The distance to a mesh's triangles; the side from pseudo-normals, and on rims from the winding number of
/// `whole`, the mesh that the triangles were taken from.
class MeshDistance final : public DistanceSource {
 public:
  MeshDistance(const Mesh& surface, std::optional<TriangleTree> whole)
      : tree_(surface), normals_(surface), whole_(std::move(whole)), bounds_(bounds_of(surface)) {
    const Vec3 size = bounds_.most_m - bounds_.least_m;
    touching_m_ = 1e-9 * norm(size);
  }

  models::FieldSample at(Vec3 p, Hint& hint) const override {
    const NearestTriangle near = tree_.nearest(p, hint.triangle);
    const models::FieldSample sample = sample_at(p, near, hint);
    hint = {near.triangle, p, sample.distance_m};
    return sample;
  }
  Box bounds() const override { return bounds_; }

 private:
  models::FieldSample sample_at(Vec3 p, const NearestTriangle& near, const Hint& hint) const {
    const Vec3 way = p - near.point_m;
    const Vec3 face = normals_.face(near.triangle);
    if (near.part == TrianglePart::face) return {dot(way, face), face};
    const double distance = std::sqrt(near.squared_distance_m2);
    if (distance <= touching_m_) return {0.0, unit(normals_.at(near.triangle, near.part))};
    const bool inside = whole_ && !normals_.tells_the_side(near.triangle, near.part)
                            ? winds_round(p, hint)
                            : dot(way, normals_.at(near.triangle, near.part)) < 0.0;
    const double sign = inside ? -1.0 : 1.0;
    return {sign * distance, (sign / distance) * way};
  }
  /// Whether p is inside, where no normal tells: as the last place, if that is nearer than any surface.
  bool winds_round(Vec3 p, const Hint& hint) const {
    if (squared_norm(p - hint.place_m) < 0.99 * hint.distance_m * hint.distance_m)
      return hint.distance_m < 0.0;
    return whole_->winding(p) > 0.5;
  }

  TriangleTree tree_;
  PseudoNormals normals_;
  std::optional<TriangleTree> whole_;
  Box bounds_;
  double touching_m_ = 0.0;
};

/// On which sides of a triangle the solid lies.
enum class Sides { surface, turned, inner, mixed };

/// Sorts a mesh's triangles into surface and inner ones, cutting those that are both.
class SurfaceSorter {
 public:
  SurfaceSorter(const Mesh& mesh, const TriangleTree& whole, double finest_m)
      : mesh_(mesh), whole_(whole), finest_m_(finest_m) {
    const Box box = bounds_of(mesh);
    const double size_m = norm(box.most_m - box.least_m);
    lift_m_ = 2e-6 * size_m;
    // A triangle larger than this is looked at in parts: another body may stand on its middle.
    look_m_ = size_m / 96.0;
  }

  struct Sorted {
    std::vector<std::array<Vec3, 3>> surface;
    std::size_t inner = 0;
  };

  /// Whether a sample of the triangles, spread over all, has the solid behind and nothing before it.
  bool looks_clean(std::uint64_t seed) const {
    constexpr std::size_t kLooks = 1500;
    std::mt19937_64 random(seed);
    const std::size_t count = mesh_.triangles.size();
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (std::size_t i = 0; i < kLooks; ++i) {
      const std::size_t index = count <= kLooks / 4 ? i % count : random() % count;
      const Triangle& t = mesh_.triangles[index];
      const Vec3 a = mesh_.vertices_m[t[0]], ab = mesh_.vertices_m[t[1]] - a, ac = mesh_.vertices_m[t[2]] - a;
      double u = uniform(random), v = uniform(random);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      if (sides_at(a + u * ab + v * ac, unit(cross(ab, ac))) != Sides::surface) return false;
    }
    return true;
  }

  void sort(std::uint32_t triangle, Sorted& sorted) const {
    const Triangle& t = mesh_.triangles[triangle];
    const std::array<Vec3, 3> corners{mesh_.vertices_m[t[0]], mesh_.vertices_m[t[1]], mesh_.vertices_m[t[2]]};
    std::vector<std::array<Vec3, 3>> pieces;
    const Sides sides = sort(corners, triangle, pieces);
    if (sides == Sides::surface) {
      sorted.surface.push_back(corners);
      return;
    }
    if (sides == Sides::inner) ++sorted.inner;
    if (sides == Sides::turned) sorted.surface.push_back({corners[0], corners[2], corners[1]});
    if (sides == Sides::mixed) sorted.surface.insert(sorted.surface.end(), pieces.begin(), pieces.end());
  }

 private:
  Sides sides_at(Vec3 place, Vec3 normal) const {
    const bool front = whole_.winding(place + lift_m_ * normal) > 0.5;
    const bool back = whole_.winding(place - lift_m_ * normal) > 0.5;
    if (front == back) return Sides::inner;
    return back ? Sides::surface : Sides::turned;
  }

  /// What the whole triangle is; where that is mixed, its surface parts are added to `pieces`.
  Sides sort(const std::array<Vec3, 3>& c, std::uint32_t triangle,
             std::vector<std::array<Vec3, 3>>& pieces) const {
    const Vec3 normal = unit(cross(c[1] - c[0], c[2] - c[0]));
    const Vec3 centre = (c[0] + c[1] + c[2]) / 3.0;
    const double longest = std::sqrt(
        std::max({squared_norm(c[1] - c[0]), squared_norm(c[2] - c[1]), squared_norm(c[0] - c[2])}));
    const double radius_m =
        1.001 * std::sqrt(std::max(
                    {squared_norm(c[0] - centre), squared_norm(c[1] - centre), squared_norm(c[2] - centre)}));
    // Sides change only where another triangle passes.
    const bool alone = longest > finest_m_ && !whole_.any_within(centre, radius_m, triangle);
    if (longest <= finest_m_ || alone) return sides_at(centre, normal);
    if (longest <= look_m_) {
      const Sides middle = sides_at(centre, normal);
      const bool same = std::all_of(c.begin(), c.end(), [&](Vec3 corner) {
        return sides_at(centre + 0.97 * (corner - centre), normal) == middle;
      });
      if (same) return middle;
    }
    // Four parts, as similar to the whole as can be.
    const Vec3 ab = 0.5 * (c[0] + c[1]), bc = 0.5 * (c[1] + c[2]), ca = 0.5 * (c[2] + c[0]);
    const std::array<std::array<Vec3, 3>, 4> quarters{
        {{c[0], ab, ca}, {ab, c[1], bc}, {ca, bc, c[2]}, {bc, ca, ab}}};
    std::array<Sides, 4> sides{};
    std::array<std::vector<std::array<Vec3, 3>>, 4> parts;
    for (std::size_t i = 0; i < 4; ++i) sides[i] = sort(quarters[i], triangle, parts[i]);
    if (sides[0] != Sides::mixed &&
        std::all_of(sides.begin(), sides.end(), [&](Sides s) { return s == sides[0]; }))
      return sides[0];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& q = quarters[i];
      if (sides[i] == Sides::surface) pieces.push_back(q);
      if (sides[i] == Sides::turned) pieces.push_back({q[0], q[2], q[1]});
      if (sides[i] == Sides::mixed) pieces.insert(pieces.end(), parts[i].begin(), parts[i].end());
    }
    return Sides::mixed;
  }

  const Mesh& mesh_;
  const TriangleTree& whole_;
  double finest_m_;
  double lift_m_ = 0.0;
  double look_m_ = 0.0;
};

SurfaceSorter::Sorted sorted_surface(const Mesh& mesh, const TriangleTree& whole, double finest_m,
                                     const Work& work) {
  const SurfaceSorter sorter(mesh, whole, finest_m);
  const auto count = static_cast<int>(mesh.triangles.size());
  constexpr int kChunk = 8;
  std::vector<SurfaceSorter::Sorted> parts(static_cast<std::size_t>((count + kChunk - 1) / kChunk));
  parallel_for(work, static_cast<int>(parts.size()), 1, [&](int begin, int end) {
    for (int part = begin; part < end && !work.cancelled(); ++part)
      for (int t = part * kChunk; t < std::min(count, (part + 1) * kChunk); ++t)
        sorter.sort(static_cast<std::uint32_t>(t), parts[static_cast<std::size_t>(part)]);
  });
  SurfaceSorter::Sorted all;
  for (const auto& part : parts) {
    all.surface.insert(all.surface.end(), part.surface.begin(), part.surface.end());
    all.inner += part.inner;
  }
  return all;
}

Mesh mesh_of(const std::vector<std::array<Vec3, 3>>& triangles) {
  Mesh soup;
  for (const auto& t : triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices_m.size());
    soup.vertices_m.insert(soup.vertices_m.end(), t.begin(), t.end());
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  std::size_t ignored = 0;
  return welded(soup, ignored);
}

}  // namespace

std::vector<std::string> MeshRepair::notes() const {
  std::vector<std::string> notes;
  const auto tell = [&](std::size_t count, const char* one, const char* many) {
    if (count == 1) notes.emplace_back(one);
    if (count > 1) notes.push_back(std::to_string(count) + many);
  };
  tell(degenerate, "One triangle without an area was left out.", " triangles without an area were left out.");
  tell(turned_parts, "One part of the mesh was turned to face outwards.",
       " parts of the mesh were turned to face outwards.");
  tell(closed_holes, "One hole in the mesh was closed.", " holes in the mesh were closed.");
  tell(inner, "One triangle inside the solid was left out.", " triangles inside the solid were left out.");
  return notes;
}

Result<MeshSolid> solid_from_mesh(const Mesh& mesh, double finest_m, const Work& work) {
  work.report(0.0, "mending the mesh");
  MeshSolid solid;
  Mesh whole = welded(mesh, solid.repair.degenerate);
  if (whole.triangles.empty()) return invalid_input("holds no triangle that has an area");
  solid.repair.triangles = whole.triangles.size();
  solid.repair.turned_parts = orient_outwards(whole, work.seed);
  solid.repair.closed_holes = close_holes(whole);
  TriangleTree tree(whole);
  work.report(0.02, "finding the solid's surface");
  if (is_watertight(whole) && SurfaceSorter(whole, tree, finest_m).looks_clean(work.seed)) {
    solid.distance = std::make_unique<MeshDistance>(whole, std::nullopt);
    return solid;
  }
  const auto sorted = sorted_surface(whole, tree, finest_m, work);
  if (work.cancelled()) return Work::interrupted();
  solid.repair.inner = sorted.inner;
  if (sorted.surface.empty()) return invalid_input("is a mesh that encloses no volume");
  solid.distance = std::make_unique<MeshDistance>(mesh_of(sorted.surface), std::move(tree));
  return solid;
}

}  // namespace palpable::sculpt
