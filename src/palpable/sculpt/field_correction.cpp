// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field_correction.hpp"

#include "palpable/sculpt/field_update.hpp"

#include <utility>
#include <vector>

namespace palpable::sculpt {

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
  after.sampled_anew = !after.field.contains(box.least_m) || !after.field.contains(box.most_m);
  auto field = after.sampled_anew
                   ? field_from_source(*after.solid, options, work)
                   : updated_field(after.field, *after.solid, after.surface.changed(), options, work);
  if (!field) return field.error();
  after.field = *std::move(field);
  return after;
}

}  // namespace palpable::sculpt
