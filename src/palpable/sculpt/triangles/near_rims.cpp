// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/near_rims.hpp"

#include "palpable/sculpt/triangles/mesh_edges.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>

namespace palpable::sculpt {
namespace {

/// Finds an earlier place near another one: places in cubes whose sides are the greatest distance.
class NearPlaces {
 public:
  NearPlaces(std::span<const Vec3> places_m, double near_m) : places_m_(places_m), near_m_(near_m) {}

  std::optional<std::uint32_t> earlier(std::uint32_t number) const {
    const Cube cube = cube_of(number);
    for (double x = -1.0; x <= 1.0; ++x)
      for (double y = -1.0; y <= 1.0; ++y)
        for (double z = -1.0; z <= 1.0; ++z) {
          const auto at = in_cubes_.find({cube[0] + x, cube[1] + y, cube[2] + z});
          if (at == in_cubes_.end()) continue;
          for (const std::uint32_t other : at->second)
            if (squared_norm(places_m_[other] - places_m_[number]) <= near_m_ * near_m_) return other;
        }
    return std::nullopt;
  }
  void add(std::uint32_t number) { in_cubes_[cube_of(number)].push_back(number); }

 private:
  using Cube = std::array<double, 3>;
  Cube cube_of(std::uint32_t number) const {
    const Vec3 p = places_m_[number];
    return {std::floor(p.x / near_m_), std::floor(p.y / near_m_), std::floor(p.z / near_m_)};
  }

  std::span<const Vec3> places_m_;
  double near_m_;
  std::map<Cube, std::vector<std::uint32_t>> in_cubes_;
};

std::set<std::uint32_t> rim_vertices(const Mesh& mesh) {
  std::set<std::uint32_t> vertices;
  visit_edges(edge_uses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() % 2 == 1)
      vertices.insert({static_cast<std::uint32_t>(edge.front().key >> 32U),
                       static_cast<std::uint32_t>(edge.front().key)});
  });
  return vertices;
}

}  // namespace

std::size_t join_near_rims(Mesh& mesh, double near_m) {
  NearPlaces kept(mesh.vertices_m, near_m);
  std::vector<std::uint32_t> now(mesh.vertices_m.size());
  std::iota(now.begin(), now.end(), 0U);
  bool is_joined = false;
  for (const std::uint32_t v : rim_vertices(mesh)) {
    if (const auto earlier = kept.earlier(v)) {
      now[v] = *earlier;
      is_joined = true;
    } else {
      kept.add(v);
    }
  }
  if (!is_joined) return 0;
  for (auto& t : mesh.triangles)
    for (std::uint32_t& v : t) v = now[v];
  return std::erase_if(mesh.triangles,
                       [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

}  // namespace palpable::sculpt
