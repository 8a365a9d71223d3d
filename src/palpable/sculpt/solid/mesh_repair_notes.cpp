// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/figure.hpp"
#include "palpable/sculpt/solid/mesh_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

namespace palpable::sculpt {
namespace {

std::string note_on_two_sided(const MeshRepair& repair) {
  const auto counted = [](std::size_t count, const char* one, const char* many) {
    return count == 1 ? std::string("one ") + one : std::to_string(count) + " " + many;
  };
  std::string note = (repair.two_sided == 1 ? std::string("One triangle occurs")
                                            : std::to_string(repair.two_sided) + " triangles occur") +
                     " with both orientations (double-sided) and " +
                     (repair.two_sided == 1 ? "was" : "were") + " used once";
  std::string parts;
  if (repair.two_sided_bodies > 0)
    parts = counted(repair.two_sided_bodies, "closed surface was filled", "closed surfaces were filled");
  if (repair.two_sided_sheets > 0)
    parts += (parts.empty() ? "" : ", ") +
             counted(repair.two_sided_sheets, "open surface is a sheet", "open surfaces are sheets");
  if (!parts.empty()) note += ": " + parts;
  note += ".";
  if (repair.two_sided_inner_shells > 0)
    note += " Of the filled ones " + std::to_string(repair.two_sided_inner_shells) +
            (repair.two_sided_inner_shells == 1 ? " lies" : " lie") +
            " in another body: double-sided triangles do not say whether that is a cavity.";
  return note;
}

/// Cosine between a direction and the axis that it is named after. One between two axes has no simple name.
constexpr double kMostly = 0.8;

std::string facing_of(Vec3 direction) {
  const std::array<double, 3> along{direction.x, direction.y, direction.z};
  constexpr std::array kNames{std::array{"left", "right"}, std::array{"down", "up"},
                              std::array{"to the back", "to the front"}};
  const auto axis = static_cast<std::size_t>(
      std::max_element(along.begin(), along.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      along.begin());
  return std::abs(along[axis]) < kMostly ? "" : std::string(", faces ") + kNames[axis][along[axis] > 0.0];
}

std::string note_on_holes(const MeshRepair& repair) {
  const auto mm = [](double metres) { return figure(1e3 * metres, 3); };
  const auto described = [&](const ClosedHole& hole) {
    const Vec3 size = hole.rim.size_m(), middle = 0.5 * (hole.rim.least_m + hole.rim.most_m);
    return mm(size.x) + " x " + mm(size.y) + " x " + mm(size.z) + " mm, its middle at (" + mm(middle.x) +
           ", " + mm(middle.y) + ", " + mm(middle.z) + ") mm" + facing_of(hole.facing);
  };
  const std::size_t listed = repair.largest_holes.size();
  std::string note = repair.closed_holes == 1
                         ? "One hole in the mesh was closed, and the space behind it is solid"
                         : std::to_string(repair.closed_holes) +
                               " holes in the mesh were closed, and the spaces behind them are solid";
  if (listed > 0)
    note += repair.closed_holes == 1 ? ": " : listed < repair.closed_holes ? ". The largest: " : ": ";
  for (std::size_t i = 0; i < listed; ++i) note += (i > 0 ? "; " : "") + described(repair.largest_holes[i]);
  const bool may_hold = std::any_of(repair.largest_holes.begin(), repair.largest_holes.end(),
                                    [](const ClosedHole& hole) { return hole.facing.y > kMostly; });
  return note + (may_hold ? ". So a vessel or a court that is open above is filled to its rim, unless its "
                            "walls and its floor also have their inner sides."
                          : ".");
}

}  // namespace

void MeshRepair::add_closed(std::span<const Vec3> vertices_m, std::span<const Hole> holes) {
  closed_holes += holes.size();
  for (const Hole& hole : holes) {
    if (hole.lid.empty()) continue;
    const Vec3 first = vertices_m[hole.lid[0][0]];
    ClosedHole closed{{first, first}, 0.0, {}};
    Vec3 sum;
    for (const auto& t : hole.lid) {
      const Vec3 a = vertices_m[t[0]], doubled = cross(vertices_m[t[1]] - a, vertices_m[t[2]] - a);
      closed.area_m2 += 0.5 * norm(doubled);
      sum += doubled;
      for (const std::uint32_t v : t) closed.rim.grow(vertices_m[v]);
    }
    if (norm(sum) > 0.0) closed.facing = unit(sum);
    const auto at = std::upper_bound(largest_holes.begin(), largest_holes.end(), closed,
                                     [](const auto& a, const auto& b) { return a.area_m2 > b.area_m2; });
    largest_holes.insert(at, closed);
    if (largest_holes.size() > kListedHoles) largest_holes.pop_back();
  }
}

std::vector<std::string> MeshRepair::notes() const {
  std::vector<std::string> notes;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count == 1) notes.emplace_back(one);
    if (count > 1) notes.push_back(std::to_string(count) + many);
  };
  add(not_finite, "One triangle with a vertex that is not a finite number was left out.",
      " triangles with a vertex that is not a finite number were left out.");
  add(degenerate, "One triangle without an area was left out.", " triangles without an area were left out.");
  add(repeated, "One triangle that occurs more than once was used once.",
      " triangles that occur more than once were used once.");
  if (two_sided > 0) notes.push_back(note_on_two_sided(*this));
  add(turned_parts, "One part of the mesh was turned to face outwards.",
      " parts of the mesh were turned to face outwards.");
  if (closed_holes > 0) notes.push_back(note_on_holes(*this));
  add(inner, "One triangle inside the solid was left out.", " triangles inside the solid were left out.");
  if (rounded > 0)
    notes.push_back(std::to_string(rounded) + " small facets were smoothed, by at most " +
                    std::to_string(std::lround(1e6 * rounded_m)) + " um.");
  add(ground, "One triangle of the ground around the solid was left out.",
      " triangles of the ground around the solid were left out.");
  const auto in_mm = [](double metres) { return figure(1e3 * metres, 2); };
  if (open_sheets > 0)
    notes.push_back((open_sheets == 1
                         ? "One open sheet, with air on both sides, was"
                         : std::to_string(open_sheets) + " open sheets, with air on both sides, were") +
                    " given a thickness of " + in_mm(wall_m) + " mm.");
  const std::size_t own_sheets = sheets - std::min(sheets, open_sheet_triangles);
  if (thin + own_sheets > 0)
    notes.push_back("Walls that are too thin for the field's cells (" + std::to_string(thin + own_sheets) +
                    " triangles, " + std::to_string(own_sheets) +
                    " of them of sheets without a thickness) were made " + in_mm(wall_m) +
                    " mm thick, so that they can be felt: at most " + in_mm(thickened_m) +
                    " mm were added to a side. More cells keep them thinner.");
  return notes;
}

}  // namespace palpable::sculpt
