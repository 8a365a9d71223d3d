// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/coincident_triangles.hpp"

#include "palpable/sculpt/triangles/mesh_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

namespace palpable::sculpt {
namespace {

using VertexTriple = std::array<std::uint32_t, 3>;

VertexTriple sorted_triple(VertexTriple t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Whether the vertices are in increasing order, up to rotation.
bool is_even(const VertexTriple& t) { return (t[0] < t[1]) == (t[1] < t[2]) ? t[0] < t[1] : t[2] < t[0]; }

/// The vertex of a triangle that is not on an edge.
std::uint32_t opposite_vertex(const VertexTriple& t, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t v : t)
    if (v != a && v != b) return v;
  return t[0];
}

/// Two triangles with a common edge, the diagonal of a quadrilateral.
struct QuadDiagonal {
  std::array<std::uint32_t, 4> vertices;
  std::array<std::uint32_t, 2> triangles;
};

Vec3 summed_normal(const Mesh& mesh, const QuadDiagonal& quad) {
  Vec3 sum;
  for (const std::uint32_t i : quad.triangles) {
    const VertexTriple& t = mesh.triangles[i];
    const Vec3 a = mesh.vertices_m[t[0]];
    sum += cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a);
  }
  return sum;
}

/// Whether the four vertices are nearly in one plane: a tetrahedron is not flat, although its faces form two
/// such quadrilaterals.
bool is_flat(const Mesh& mesh, const QuadDiagonal& quad) {
  const auto at = [&](std::size_t k) { return mesh.vertices_m[quad.vertices[k]]; };
  const Vec3 a = at(1) - at(0), b = at(2) - at(0), c = at(3) - at(0);
  const double longest_m = std::max({norm(a), norm(b), norm(c)});
  constexpr double kFlatShare = 0.05;
  return std::abs(dot(a, cross(b, c))) <= kFlatShare * longest_m * norm(summed_normal(mesh, quad));
}

/// Where two quadrilaterals with opposite orientations are divided by different diagonals, the second one is
/// divided like the first.
void match_diagonals(Mesh& mesh) {
  std::vector<QuadDiagonal> quads;
  visit_edges(edge_uses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].step + edge[1].step != 0) return;
    const auto a = static_cast<std::uint32_t>(edge[0].key >> 32U),
               b = static_cast<std::uint32_t>(edge[0].key);
    QuadDiagonal quad{{a, b, opposite_vertex(mesh.triangles[edge[0].triangle], a, b),
                       opposite_vertex(mesh.triangles[edge[1].triangle], a, b)},
                      {edge[0].triangle, edge[1].triangle}};
    std::sort(quad.vertices.begin(), quad.vertices.end());
    quads.push_back(quad);
  });
  std::sort(quads.begin(), quads.end(), [](const QuadDiagonal& a, const QuadDiagonal& b) {
    return std::pair(a.vertices, a.triangles) < std::pair(b.vertices, b.triangles);
  });
  for (std::size_t i = 0; i + 1 < quads.size(); ++i) {
    const QuadDiagonal &one = quads[i], &other = quads[i + 1];
    if (one.vertices != other.vertices) continue;
    if (!is_flat(mesh, one) || !(dot(summed_normal(mesh, one), summed_normal(mesh, other)) < 0.0)) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      VertexTriple t = mesh.triangles[one.triangles[k]];
      std::swap(t[1], t[2]);
      mesh.triangles[other.triangles[k]] = t;
    }
    ++i;
  }
}

}  // namespace

CoincidentTriangles merge_coincident(Mesh& mesh) {
  match_diagonals(mesh);
  const std::size_t count = mesh.triangles.size();
  std::vector<std::pair<VertexTriple, std::uint32_t>> sorted(count);
  for (std::uint32_t t = 0; t < count; ++t) sorted[t] = {sorted_triple(mesh.triangles[t]), t};
  std::sort(sorted.begin(), sorted.end());
  std::vector<char> is_removed(count), is_two_sided(count);
  CoincidentTriangles found;
  std::size_t two_sided = 0;
  for (std::size_t i = 0, end = 0; i < count; i = end) {
    std::size_t as_first = 0;
    const bool first = is_even(mesh.triangles[sorted[i].second]);
    for (; end < count && sorted[end].first == sorted[i].first; ++end) {
      as_first += is_even(mesh.triangles[sorted[end].second]) == first ? 1 : 0;
      if (end > i) is_removed[sorted[end].second] = 1;
    }
    const bool both = as_first < end - i;
    found.repeated += end - i - (both ? 2 : 1);
    if (!both) continue;
    is_two_sided[sorted[i].second] = 1;
    ++two_sided;
  }
  if (two_sided + found.repeated == 0) return found;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < count; ++t) {
    if (is_removed[t] != 0) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    is_two_sided[kept++] = is_two_sided[t];
  }
  mesh.triangles.resize(kept);
  if (two_sided == 0) return found;
  is_two_sided.resize(kept);
  found.is_two_sided = std::move(is_two_sided);
  return found;
}

}  // namespace palpable::sculpt
