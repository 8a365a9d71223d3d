// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/joined_bodies.hpp"

#include "palpable/sculpt/triangles/mesh_edges.hpp"
#include "palpable/sculpt/triangles/mesh_orientation.hpp"
#include "palpable/sculpt/triangles/touching_edges.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

double lid_area_m2(const Mesh& mesh, const Hole& hole) {
  double area_m2 = 0.0;
  for (const auto& t : hole.lid) {
    const Vec3 a = mesh.vertices_m[t[0]];
    area_m2 += 0.5 * norm(cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a));
  }
  return area_m2;
}

/// The triangles of a mesh by its connected surfaces. A surface's number is its first triangle.
struct Surfaces {
  std::vector<std::uint32_t> of_triangle;
  /// The area of each surface's lids, at its number; negative if it has no hole.
  std::vector<double> lids_m2;

  Surfaces(const Mesh& mesh, std::span<const Hole> holes)
      : of_triangle(connected_by_edges(mesh.triangles.size(), edge_uses(mesh.triangles))),
        lids_m2(mesh.triangles.size(), -1.0) {
    for (const Hole& hole : holes) {
      double& lids = lids_m2[of_triangle[hole.rim.front().triangle]];
      lids = std::max(lids, 0.0) + lid_area_m2(mesh, hole);
    }
  }
};

/// For each triangle of `mesh`, which is a part of the triangle `given` of the surfaces `before`, whether its
/// surface consists of several of these, has smaller lids than they have, and is no sheet.
std::vector<char> of_joined_bodies(const Mesh& mesh, std::span<const std::uint32_t> given,
                                   const Surfaces& before, double touching_m,
                                   const OpenSheetOptions& options) {
  const std::vector<Hole> holes = holes_of(mesh.vertices_m, mesh.triangles);
  const Surfaces now(mesh, holes);
  const OpenSheets sheets = open_sheets_of(mesh, holes, touching_m, options);
  const std::size_t count = mesh.triangles.size();
  // Of each surface, at its number: the lids and the number of those that it consists of.
  std::vector<double> lids_before_m2(count);
  std::vector<std::uint32_t> parts(count);
  std::vector<char> is_counted(before.of_triangle.size()), is_sheet(count), is_joined(count);
  for (std::size_t t = 0; t < count; ++t) {
    const std::uint32_t surface = now.of_triangle[t], part = before.of_triangle[given[t]];
    if (sheets.count > 0 && sheets.of_triangle[t] != OpenSheets::kNone) is_sheet[surface] = 1;
    if (std::exchange(is_counted[part], 1) != 0) continue;
    ++parts[surface];
    lids_before_m2[surface] += before.lids_m2[part];
  }
  // Lids that differ by rounding are the same.
  constexpr double kSmaller = 1.0 - 1e-6;
  for (std::size_t t = 0; t < count; ++t) {
    const std::uint32_t s = now.of_triangle[t];
    is_joined[t] = parts[s] > 1 && is_sheet[s] == 0 && now.lids_m2[s] < kSmaller * lids_before_m2[s];
  }
  return is_joined;
}

}  // namespace

bool join_bodies(Mesh& whole, std::span<const Hole> holes, const TouchingDistances& distances,
                 const OpenSheetOptions& options, std::uint64_t seed) {
  const Surfaces before(whole, holes);
  const auto is_open = [](double lids_m2) { return lids_m2 >= 0.0; };
  if (std::count_if(before.lids_m2.begin(), before.lids_m2.end(), is_open) < 2) return false;
  Mesh open;
  open.vertices_m = whole.vertices_m;
  std::vector<std::uint32_t> index;
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t)
    if (is_open(before.lids_m2[before.of_triangle[t]]))
      index.push_back(t), open.triangles.push_back(whole.triangles[t]);
  std::optional<DividedMesh> divided = divide_touching_edges(open, distances.same_m, TouchingEdges::rims);
  if (!divided) return false;
  Mesh& mesh = divided->mesh;
  orient_outwards(mesh, seed);
  std::vector<std::uint32_t> given;
  for (const std::uint32_t part : divided->part_of) given.push_back(index[part]);
  const std::vector<char> is_joined = of_joined_bodies(mesh, given, before, distances.touching_m, options);
  std::vector<char> is_replaced(whole.triangles.size());
  std::vector<std::array<std::uint32_t, 3>> added;
  for (std::size_t t = 0; t < is_joined.size(); ++t)
    if (is_joined[t] != 0) is_replaced[given[t]] = 1, added.push_back(mesh.triangles[t]);
  if (added.empty()) return false;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t t = 0; t < whole.triangles.size(); ++t)
    if (is_replaced[t] == 0) triangles.push_back(whole.triangles[t]);
  triangles.insert(triangles.end(), added.begin(), added.end());
  whole.triangles = std::move(triangles);
  return true;
}

}  // namespace palpable::sculpt
