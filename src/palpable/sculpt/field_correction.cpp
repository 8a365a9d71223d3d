// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field_correction.hpp"

#include "palpable/sculpt/field_update.hpp"
#include "palpable/sculpt/mesh_distance.hpp"

#include <utility>

namespace palpable::sculpt {

Result<CorrectedField> corrected_field(CorrectedField before, const Mesh& measured,
                                       const CorrectionOptions& correction, const FieldOptions& options,
                                       const Work& work) {
  auto surface = correct_surface(std::move(before.surface), measured, correction, work);
  if (!surface) return surface.error();
  CorrectedField after{std::move(before.field), *std::move(surface)};
  const Mesh changed = after.surface.changed();
  if (changed.triangles.empty()) return after;
  const Mesh adapted = after.surface.adapted();
  const auto distance = mesh_distance(adapted, adapted);
  const Box box = distance->bounds();
  after.sampled_anew = !after.field.contains(box.least_m) || !after.field.contains(box.most_m);
  auto field = after.sampled_anew ? field_from_source(*distance, options, work)
                                  : updated_field(after.field, *distance, changed, options, work);
  if (!field) return field.error();
  after.field = *std::move(field);
  return after;
}

}  // namespace palpable::sculpt
