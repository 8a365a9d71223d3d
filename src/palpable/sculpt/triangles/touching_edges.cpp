// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/touching_edges.hpp"

#include "palpable/sculpt/triangles/mesh_edges.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <utility>

namespace palpable::sculpt {
namespace {

using Indices = std::array<std::uint32_t, 3>;
/// For each edge the vertices on it, from its lower vertex to its higher one.
using Divisions = std::map<std::uint64_t, std::vector<std::uint32_t>>;

class EdgeDivider {
 public:
  EdgeDivider(const Mesh& mesh, double touching_m, TouchingEdges which)
      : mesh_(mesh), touching_m_(touching_m), which_(which) {}

  Divisions divisions() {
    const std::vector<EdgeUse> uses = edge_uses(mesh_.triangles);
    std::vector<std::array<std::uint32_t, 2>> rim;
    bool is_branched = false;
    visit_edges(uses, [&](std::span<const EdgeUse> edge) {
      is_branched = is_branched || edge.size() > 2;
      if (edge.size() % 2 == 1)
        rim.push_back({static_cast<std::uint32_t>(edge.front().key >> 32U),
                       static_cast<std::uint32_t>(edge.front().key)});
    });
    if (rim.empty()) return {};
    if (which_ == TouchingEdges::all && !is_branched && is_one_surface(uses)) return {};
    const TriangleTree tree(mesh_);
    std::set<std::uint32_t> rim_vertices;
    for (const auto& [from, to] : rim) rim_vertices.insert({from, to});
    for (const auto& [from, to] : rim)
      visit_near({mesh_.vertices_m[from], mesh_.vertices_m[to]}, tree, [&](const Indices& t) {
        for (const std::uint32_t v : t)
          if (which_ == TouchingEdges::all || rim_vertices.contains(v)) add_if_on(from, to, v);
      });
    if (which_ == TouchingEdges::all)
      for (const std::uint32_t v : rim_vertices)
        visit_near({mesh_.vertices_m[v], mesh_.vertices_m[v]}, tree, [&](const Indices& t) {
          for (std::size_t k = 0; k < 3; ++k) add_if_on(t[k], t[(k + 1) % 3], v);
        });
    Divisions divisions;
    for (const auto& [key, vertices] : on_edges_) {
      const Vec3 from = mesh_.vertices_m[key >> 32U];
      std::vector<std::uint32_t> sorted(vertices.begin(), vertices.end());
      std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
        return squared_norm(mesh_.vertices_m[a] - from) < squared_norm(mesh_.vertices_m[b] - from);
      });
      divisions[key] = std::move(sorted);
    }
    return divisions;
  }

 private:
  bool is_one_surface(std::span<const EdgeUse> uses) const {
    const auto surfaces = connected_by_edges(mesh_.triangles.size(), uses);
    return std::count(surfaces.begin(), surfaces.end(), 0U) ==
           static_cast<std::ptrdiff_t>(mesh_.triangles.size());
  }
  template <class Visit>
  void visit_near(std::array<Vec3, 2> places, const TriangleTree& tree, Visit&& visit) {
    const Box box = bounds_of(std::span<const Vec3>(places));
    const Vec3 by{touching_m_, touching_m_, touching_m_};
    tree.visit_box(box.least_m - by, box.most_m + by,
                   [&](std::uint32_t other) { visit(mesh_.triangles[other]); });
  }
  void add_if_on(std::uint32_t a, std::uint32_t b, std::uint32_t v) {
    if (v == a || v == b) return;
    const Vec3 from = mesh_.vertices_m[std::min(a, b)], way = mesh_.vertices_m[std::max(a, b)] - from,
               to_v = mesh_.vertices_m[v] - from;
    const double share = dot(to_v, way) / squared_norm(way);
    if (!(share > 0.0) || !(share < 1.0)) return;
    if (squared_norm(to_v - share * way) > touching_m_ * touching_m_) return;
    on_edges_[edge_key(a, b)].insert(v);
  }

  const Mesh& mesh_;
  double touching_m_;
  TouchingEdges which_;
  std::map<std::uint64_t, std::set<std::uint32_t>> on_edges_;
};

/// The vertices strictly between two vertices of an edge, from `a` to `b`. `line`: all vertices of the edge.
std::vector<std::uint32_t> between(const std::vector<std::uint32_t>& line, std::uint32_t a, std::uint32_t b) {
  if (a == b) return {};
  const auto first = std::find(line.begin(), line.end(), a), last = std::find(line.begin(), line.end(), b);
  if (first == line.end() || last == line.end()) return {};
  std::vector<std::uint32_t> found;
  if (first < last)
    found.assign(first + 1, last);
  else
    found.assign(std::make_reverse_iterator(first), std::make_reverse_iterator(last + 1));
  return found;
}

/// Divides one triangle. `lines`: for each of its three sides all vertices on it, with its ends. No vertex is
/// strictly inside two of them and no corner is strictly inside one, so that every piece has fewer inside.
void divide(const Indices& t, std::span<const std::vector<std::uint32_t>> lines,
            std::vector<Indices>& pieces) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    for (const auto& line : lines) {
      const auto inner = between(line, a, b);
      if (inner.empty()) continue;
      const std::uint32_t middle = inner[inner.size() / 2];
      divide({a, middle, c}, lines, pieces);
      divide({middle, b, c}, lines, pieces);
      return;
    }
  }
  pieces.push_back(t);
}

/// The divided sides of a triangle, each from its lower vertex to its higher one. Where a triangle is so
/// narrow that a vertex touches two of its sides, or a corner the side opposite, only the first side has it.
std::vector<std::vector<std::uint32_t>> divided_sides(const Indices& t, const Divisions& divisions) {
  std::vector<std::vector<std::uint32_t>> lines;
  std::set<std::uint32_t> used(t.begin(), t.end());
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = t[k], b = t[(k + 1) % 3];
    const auto at = divisions.find(edge_key(a, b));
    if (at == divisions.end()) continue;
    std::vector<std::uint32_t> line{std::min(a, b)};
    for (const std::uint32_t v : at->second)
      if (used.insert(v).second) line.push_back(v);
    line.push_back(std::max(a, b));
    if (line.size() > 2) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

std::optional<DividedMesh> divide_touching_edges(const Mesh& mesh, double touching_m, TouchingEdges which) {
  const Divisions divisions = EdgeDivider(mesh, touching_m, which).divisions();
  if (divisions.empty()) return std::nullopt;
  DividedMesh divided;
  divided.mesh.vertices_m = mesh.vertices_m;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Indices t = mesh.triangles[i];
    divide(t, divided_sides(t, divisions), divided.mesh.triangles);
    divided.part_of.resize(divided.mesh.triangles.size(), i);
  }
  return divided;
}

}  // namespace palpable::sculpt
