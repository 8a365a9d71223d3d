// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/small_facets.hpp"

#include "palpable/sculpt/triangles/mesh_edges.hpp"

#include <cstdint>
#include <span>

namespace palpable::sculpt {

std::vector<FacetTolerance> facet_tolerances(const Mesh& mesh, const SmallFacets& small) {
  std::vector<FacetTolerance> tolerances(mesh.triangles.size());
  const auto corners_of = [&](std::uint32_t t) {
    const auto& of = mesh.triangles[t];
    return std::array{mesh.vertices_m[of[0]], mesh.vertices_m[of[1]], mesh.vertices_m[of[2]]};
  };
  const auto normal_of = [](const std::array<Vec3, 3>& t) { return unit(cross(t[1] - t[0], t[2] - t[0])); };
  const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
  visit_edges(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].step + edge[1].step != 0) return;
    const auto a = corners_of(edge[0].triangle), b = corners_of(edge[1].triangle);
    const Vec3 na = normal_of(a), nb = normal_of(b);
    if (dot(na, nb) <= kSmoothCosine || std::max(inradius_m(a), inradius_m(b)) > small.largest_facet_m)
      return;
    const double turn = norm(na - nb);
    const auto vertex = [&](std::uint64_t v) { return mesh.vertices_m[static_cast<std::uint32_t>(v)]; };
    const double edge_m = norm(vertex(edge[0].key >> 32U) - vertex(edge[0].key));
    const double rise_m = bulge_over_edge_m(a, b, edge_m, turn);
    if (rise_m > small.most_m) return;
    for (const EdgeUse& use : edge) {
      FacetTolerance& t = tolerances[use.triangle];
      t.rise_m = std::max(t.rise_m, static_cast<float>(rise_m));
      t.turn = std::max(t.turn, static_cast<float>(turn));
    }
  });
  return tolerances;
}

}  // namespace palpable::sculpt
