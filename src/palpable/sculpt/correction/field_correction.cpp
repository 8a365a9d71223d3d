// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/correction/field_correction.hpp"

#include <utility>
#include <vector>

namespace palpable::sculpt {

SolidChange change_of(const CorrectedSurface& surface, double cell_m, const CorrectionOptions& options) {
  SolidChange change;
  change.triangles = surface.changed();
  change.step_m = surface.greatest_step_m();
  // A margin of a cell: leaves are fitted to samples half a cell beyond their border, and facets lie below
  // the curved surface.
  const double within_m = options.transition_m + change.step_m + cell_m;
  if (options.volume == CorrectedVolume::everywhere || surface.matched.empty() ||
      change.step_m > 0.5 * within_m)
    return change;
  change.around = surface.matched_surface();
  change.within_m = within_m;
  return change;
}

Result<CorrectedField> corrected_field(CorrectedField before, const Mesh& measured,
                                       const CorrectionOptions& correction, const FieldOptions& options,
                                       const Work& work) {
  auto surface = correct_surface(std::move(before.surface), measured, correction, work);
  if (!surface) return surface.error();
  CorrectedField after{std::move(before.field), *std::move(surface), std::move(before.solid)};
  if (after.surface.moved.empty()) return after;
  if (after.solid) {
    std::vector<SmoothSurface::Move> moves;
    moves.reserve(after.surface.moved.size());
    for (const CorrectedSurface::Moved& m : after.surface.moved)
      moves.push_back(
          {m.sample, after.surface.predicted.vertices_m[m.sample] + after.surface.translations_m[m.sample]});
    after.solid->move(moves);
  } else {
    after.solid.emplace(after.surface.adapted());
  }
  const Box box = after.solid->bounds();
  after.rebuilt = !after.field.contains({box.least_m}) || !after.field.contains({box.most_m});
  if (!after.rebuilt) {
    auto field = updated_field(after.field, *after.solid,
                               change_of(after.surface, after.field.cell_m(), correction), options, work);
    if (!field) return field.error();
    if (*field) {
      after.field = **std::move(field);
      return after;
    }
    after.rebuilt = true;
  }
  auto field = field_from_source(*after.solid, options, work);
  if (!field) return field.error();
  after.field = *std::move(field);
  return after;
}

}  // namespace palpable::sculpt
