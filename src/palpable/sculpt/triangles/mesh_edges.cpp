// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/mesh_edges.hpp"

#include "palpable/core/numbers/disjoint_sets.hpp"

#include <utility>

namespace palpable::sculpt {

std::vector<EdgeUse> edge_uses(std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      uses.push_back({edge_key(from, to), t, from < to ? 1 : -1});
    }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::pair(a.key, a.triangle) < std::pair(b.key, b.triangle);
  });
  return uses;
}

std::vector<std::uint32_t> connected_by_edges(std::size_t triangles, std::span<const EdgeUse> uses) {
  DisjointSets sets(triangles);
  visit_edges(uses, [&](std::span<const EdgeUse> edge) {
    for (const EdgeUse& use : edge) sets.join(edge.front().triangle, use.triangle);
  });
  return sets.firsts();
}

}  // namespace palpable::sculpt
