// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/hole_closing.hpp"

#include "palpable/sculpt/triangles/mesh_edges.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace palpable::sculpt {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Cost of a triangulation: its sharpest fold, then its area.
struct Weight {
  double fold = 0.0;
  double area_m2 = 0.0;

  bool is_less_than(const Weight& other) const {
    // Folds that differ by their rounding are the same.
    constexpr double kSame = 1e-9;
    if (fold < other.fold - kSame) return true;
    return fold <= other.fold + kSame && area_m2 < other.area_m2;
  }
};

/// Fold of a triangle without an area: greater than any other.
constexpr double kDegenerate = 3.0;

/// By how much the cosine between two neighbours' normals is below that of 120 degrees. A lid meets walls at
/// about 90 degrees, so angles up to that count as 0.
double fold_between(Vec3 a, Vec3 b) {
  constexpr double kLeastCosine = -0.5;
  if (squared_norm(a) == 0.0 || squared_norm(b) == 0.0) return 0.0;
  return std::max(0.0, kLeastCosine - dot(a, b));
}

/// Dynamic programming over the parts of a rim from one of its places to a later one.
class Triangulation {
 public:
  Triangulation(std::span<const Vec3> rim, std::span<const Vec3> normals)
      : rim_(rim), normals_(normals), count_(rim.size()), parts_(count_ * count_) {
    for (std::size_t span = 2; span < count_; ++span)
      for (std::size_t from = 0; from + span < count_; ++from) solve(from, from + span);
  }
  /// Appends the triangles of the whole rim.
  void collect(std::vector<Triangle>& triangles) const {
    std::vector<std::pair<std::size_t, std::size_t>> left{{0, count_ - 1}};
    while (!left.empty()) {
      const auto [from, to] = left.back();
      left.pop_back();
      if (to - from < 2) continue;
      const Part& best = part(from, to);
      if (squared_norm(best.normal) > 0.0)
        triangles.push_back({static_cast<std::uint32_t>(to), static_cast<std::uint32_t>(best.middle),
                             static_cast<std::uint32_t>(from)});
      left.emplace_back(from, best.middle);
      left.emplace_back(best.middle, to);
    }
  }

 private:
  /// The best triangulation of the places `from` to `to`, and its triangle at the edge that joins these two.
  struct Part {
    Weight weight;
    Vec3 normal;
    std::size_t middle = 0;
  };
  const Part& part(std::size_t from, std::size_t to) const { return parts_[from * count_ + to]; }
  Vec3 normal_across(std::size_t from, std::size_t to) const {
    return to - from == 1 ? normals_[from] : part(from, to).normal;
  }

  void solve(std::size_t from, std::size_t to) {
    Part best;
    best.weight.fold = std::numeric_limits<double>::infinity();
    for (std::size_t middle = from + 1; middle < to; ++middle) {
      const Vec3 doubled = cross(rim_[middle] - rim_[to], rim_[from] - rim_[to]);
      const double length = norm(doubled);
      const Weight &before = part(from, middle).weight, &after = part(middle, to).weight;
      Weight weight{std::max(before.fold, after.fold), before.area_m2 + after.area_m2 + 0.5 * length};
      Vec3 normal;
      if (length > 0.0) {
        normal = doubled / length;
        weight.fold = std::max({weight.fold, fold_between(normal, normal_across(from, middle)),
                                fold_between(normal, normal_across(middle, to))});
        if (from == 0 && to == count_ - 1)
          weight.fold = std::max(weight.fold, fold_between(normal, normals_[count_ - 1]));
      } else {
        weight.fold = kDegenerate;
      }
      if (weight.is_less_than(best.weight)) best = {weight, normal, middle};
    }
    parts_[from * count_ + to] = best;
  }

  std::span<const Vec3> rim_, normals_;
  std::size_t count_;
  std::vector<Part> parts_;
};

/// A longer rim is divided, since the work grows with the cube of its number of vertices.
constexpr std::size_t kMostPlaces = 256;

/// The shortest chord that leaves at least a quarter of the places on each side.
std::pair<std::size_t, std::size_t> shortest_chord(std::span<const Vec3> rim) {
  const std::size_t count = rim.size();
  std::pair<std::size_t, std::size_t> best{0, count / 2};
  double least2 = std::numeric_limits<double>::infinity();
  for (std::size_t from = 0; from < count; ++from)
    for (std::size_t to = from + count / 4; to < std::min(count, from + count - count / 4); ++to) {
      const double length2 = squared_norm(rim[to] - rim[from]);
      if (length2 < least2) least2 = length2, best = {from, to};
    }
  return best;
}

void add_triangles(std::span<const Vec3> rim, std::span<const Vec3> normals,
                   std::span<const std::uint32_t> names, std::vector<Triangle>& triangles) {
  if (rim.size() <= kMostPlaces) {
    std::vector<Triangle> own;
    Triangulation(rim, normals).collect(own);
    for (const Triangle& t : own) triangles.push_back({names[t[0]], names[t[1]], names[t[2]]});
    return;
  }
  const auto [from, to] = shortest_chord(rim);
  for (const bool inner : {true, false}) {
    std::vector<Vec3> places, across;
    std::vector<std::uint32_t> own;
    const std::size_t begin = inner ? from : to, count = inner ? to - from + 1 : rim.size() - to + from + 1;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = (begin + i) % rim.size();
      places.push_back(rim[at]);
      across.push_back(i + 1 < count ? normals[at] : Vec3{});
      own.push_back(names[at]);
    }
    add_triangles(places, across, own, triangles);
  }
}

/// The edges of rims by the surface that they belong to and the vertex where they start, in a fixed order.
/// Surfaces that are connected across edges are known by their first triangle.
using Rim = std::multimap<std::pair<std::uint32_t, std::uint32_t>, Hole::RimEdge>;

Rim rim_of(std::span<const Triangle> triangles) {
  const std::vector<EdgeUse> uses = edge_uses(triangles);
  const std::vector<std::uint32_t> surface = connected_by_edges(triangles.size(), uses);
  Rim rim;
  visit_edges(uses, [&](std::span<const EdgeUse> edge) {
    // Uses of an edge in one direction minus those in the other. Where they cancel, as at walls that two
    // bodies share, there is no rim.
    int left = 0;
    for (const EdgeUse& use : edge) left += use.step;
    for (const EdgeUse& use : edge) {
      if (left * use.step <= 0) continue;
      left -= use.step;
      auto from = static_cast<std::uint32_t>(use.key >> 32U), to = static_cast<std::uint32_t>(use.key);
      if (use.step < 0) std::swap(from, to);
      rim.emplace(std::pair(surface[use.triangle], from), Hole::RimEdge{from, to, use.triangle});
    }
  });
  return rim;
}

std::vector<Triangle> lid_over(std::span<const Hole::RimEdge> rim, std::span<const Vec3> vertices_m,
                               std::span<const Triangle> triangles) {
  std::vector<Vec3> places, normals;
  std::vector<std::uint32_t> names;
  for (const Hole::RimEdge& edge : rim) {
    const Triangle& t = triangles[edge.triangle];
    const Vec3 a = vertices_m[t[0]];
    places.push_back(vertices_m[edge.from]);
    normals.push_back(unit(cross(vertices_m[t[1]] - a, vertices_m[t[2]] - a)));
    names.push_back(edge.from);
  }
  std::vector<Triangle> lid;
  add_triangles(places, normals, names, lid);
  return lid;
}

}  // namespace

std::vector<Triangle> triangulated_hole(std::span<const Vec3> rim, std::span<const Vec3> normals) {
  std::vector<std::uint32_t> names(rim.size());
  std::iota(names.begin(), names.end(), 0U);
  std::vector<Triangle> triangles;
  add_triangles(rim, normals, names, triangles);
  return triangles;
}

std::vector<Hole> holes_of(std::span<const Vec3> vertices_m, std::span<const Triangle> triangles) {
  Rim rim = rim_of(triangles);
  std::vector<Hole> holes;
  // At each vertex as many edges end as start, so each walk along them returns to a vertex that it has
  // visited.
  while (!rim.empty()) {
    const std::uint32_t surface = rim.begin()->first.first;
    std::vector<Hole::RimEdge> way;
    for (auto edge = rim.begin(); edge != rim.end(); edge = rim.find({surface, way.back().to})) {
      const Hole::RimEdge next = edge->second;
      rim.erase(edge);
      way.push_back(next);
      const auto first = std::find_if(way.begin(), way.end(),
                                      [&](const Hole::RimEdge& before) { return before.from == next.to; });
      if (first == way.end()) continue;
      // Slits without an area, where one edge meets several in a row, are not holes.
      if (way.end() - first >= 3) {
        Hole hole{{first, way.end()}, {}};
        hole.lid = lid_over(hole.rim, vertices_m, triangles);
        if (!hole.lid.empty()) holes.push_back(std::move(hole));
      }
      way.erase(first, way.end());
      if (way.empty()) break;
    }
  }
  return holes;
}

std::size_t add_lids(Mesh& mesh, std::span<const Hole> holes) {
  for (const Hole& hole : holes)
    mesh.triangles.insert(mesh.triangles.end(), hole.lid.begin(), hole.lid.end());
  return holes.size();
}

std::size_t close_holes(Mesh& mesh) { return add_lids(mesh, holes_of(mesh.vertices_m, mesh.triangles)); }

}  // namespace palpable::sculpt
