// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/figure.hpp"
#include "palpable/sculpt/solid/mesh_repair.hpp"

#include <algorithm>
#include <cmath>
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

}  // namespace

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
  add(closed_holes, "One hole in the mesh was closed.", " holes in the mesh were closed.");
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
