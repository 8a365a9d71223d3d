// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/joined_sheets.hpp"

#include "palpable/sculpt/triangles/mesh_edges.hpp"
#include "palpable/sculpt/triangles/mesh_orientation.hpp"
#include "palpable/sculpt/triangles/touching_edges.hpp"

#include <cstddef>
#include <optional>
#include <utility>

namespace palpable::sculpt {
namespace {

/// The judgement of joined sheets beside the bodies, which get vertices of their own, so that they stay
/// separate.
OpenSheets sheets_beside_bodies(const Mesh& joined, const Mesh& whole, const OpenSheets& found,
                                double touching_m, const OpenSheetOptions& options) {
  Mesh all = joined;
  const auto first = static_cast<std::uint32_t>(all.vertices_m.size());
  all.vertices_m.insert(all.vertices_m.end(), whole.vertices_m.begin(), whole.vertices_m.end());
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const auto& own = whole.triangles[t];
    if (found.of_triangle[t] == OpenSheets::kNone)
      all.triangles.push_back({own[0] + first, own[1] + first, own[2] + first});
  }
  return open_sheets_of(all, holes_of(all.vertices_m, all.triangles), touching_m, options);
}

/// For each triangle of joined sheets, whether its surface consists of several sheets (`sheet_of`) and no
/// part of it is still a sheet.
std::vector<char> of_new_bodies(const Mesh& joined, const std::vector<std::uint32_t>& sheet_of,
                                const OpenSheets& still) {
  const std::size_t count = joined.triangles.size();
  const auto surface = connected_by_edges(count, edge_uses(joined.triangles));
  std::vector<std::uint32_t> only_sheet(count, OpenSheets::kNone);
  std::vector<char> is_joined(count), is_sheet(count), is_new(count);
  for (std::size_t t = 0; t < count; ++t) {
    std::uint32_t& first = only_sheet[surface[t]];
    if (first == OpenSheets::kNone) first = sheet_of[t];
    if (sheet_of[t] != first) is_joined[surface[t]] = 1;
    if (still.count > 0 && still.of_triangle[t] != OpenSheets::kNone) is_sheet[surface[t]] = 1;
  }
  for (std::size_t t = 0; t < count; ++t)
    is_new[t] = is_joined[surface[t]] != 0 && is_sheet[surface[t]] == 0 ? 1 : 0;
  return is_new;
}

}  // namespace

void join_sheets(const Mesh& whole, std::vector<std::array<std::uint32_t, 3>>& given, OpenSheets& found,
                 const TouchingDistances& distances, const OpenSheetOptions& options, std::uint64_t seed) {
  Mesh sheets;
  sheets.vertices_m = whole.vertices_m;
  std::vector<std::uint32_t> index;
  for (std::uint32_t t = 0; t < given.size(); ++t)
    if (found.of_triangle[t] != OpenSheets::kNone) index.push_back(t), sheets.triangles.push_back(given[t]);
  std::optional<DividedMesh> joined = divide_touching_edges(sheets, distances.same_m, TouchingEdges::rims);
  if (!joined) return;
  Mesh& mesh = joined->mesh;
  orient_outwards(mesh, seed);
  std::vector<std::uint32_t> sheet_of;
  for (const std::uint32_t part : joined->part_of) sheet_of.push_back(found.of_triangle[index[part]]);
  const std::vector<char> is_new =
      of_new_bodies(mesh, sheet_of, sheets_beside_bodies(mesh, whole, found, distances.touching_m, options));
  std::vector<char> is_replaced(given.size());
  for (std::size_t t = 0; t < is_new.size(); ++t)
    if (is_new[t] != 0) is_replaced[index[joined->part_of[t]]] = 1;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> of_triangle;
  for (std::size_t t = 0; t < given.size(); ++t)
    if (is_replaced[t] == 0) triangles.push_back(given[t]), of_triangle.push_back(found.of_triangle[t]);
  for (std::size_t t = 0; t < is_new.size(); ++t)
    if (is_new[t] != 0) triangles.push_back(mesh.triangles[t]), of_triangle.push_back(OpenSheets::kNone);
  given = std::move(triangles);
  found.of_triangle = std::move(of_triangle);
}

}  // namespace palpable::sculpt
