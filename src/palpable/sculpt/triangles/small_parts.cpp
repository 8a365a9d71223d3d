// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/small_parts.hpp"

#include "palpable/core/numbers/disjoint_sets.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace palpable::sculpt {
namespace {

double longest_side_m(const Box& box) {
  const Vec3 size = box.size_m();
  return std::max({size.x, size.y, size.z});
}

}  // namespace

Mesh without_small_parts(const Mesh& mesh, double least_share) {
  DisjointSets parts(mesh.vertices_m.size());
  for (const auto& t : mesh.triangles) parts.join(t[0], t[1]), parts.join(t[0], t[2]);
  constexpr double kFar = std::numeric_limits<double>::max();
  const Box nothing{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  std::vector<Box> boxes(mesh.vertices_m.size(), nothing);
  Box whole = nothing;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t vertex : t) {
      boxes[parts.find(vertex)].grow(mesh.vertices_m[vertex]);
      whole.grow(mesh.vertices_m[vertex]);
    }
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> renumbered(mesh.vertices_m.size(), kUnused);
  Mesh out;
  for (const auto& t : mesh.triangles) {
    if (longest_side_m(boxes[parts.find(t[0])]) < least_share * longest_side_m(whole)) continue;
    auto& triangle = out.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& number = renumbered[t[k]];
      if (number == kUnused) {
        number = static_cast<std::uint32_t>(out.vertices_m.size());
        out.vertices_m.push_back(mesh.vertices_m[t[k]]);
      }
      triangle[k] = number;
    }
  }
  return out;
}

}  // namespace palpable::sculpt
