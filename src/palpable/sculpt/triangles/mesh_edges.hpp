// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// The same for both directions of an edge.
inline std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32U | std::max(a, b);
}

/// One triangle at an edge. `step` is +1 if the triangle uses the edge from its lower to its higher vertex,
/// else -1.
struct EdgeUse {
  std::uint64_t key = 0;
  std::uint32_t triangle = 0;
  int step = 0;
};

/// The uses of all edges, those of one edge next to each other.
std::vector<EdgeUse> edge_uses(std::span<const std::array<std::uint32_t, 3>> triangles);

/// Calls visit(uses) for each edge.
template <class Visit>
void visit_edges(std::span<const EdgeUse> uses, Visit&& visit) {
  for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
    while (end < uses.size() && uses[end].key == uses[i].key) ++end;
    visit(uses.subspan(i, end - i));
  }
}

/// For each triangle the first one that is connected to it across edges.
std::vector<std::uint32_t> connected_by_edges(std::size_t triangles, std::span<const EdgeUse> uses);

}  // namespace palpable::sculpt
