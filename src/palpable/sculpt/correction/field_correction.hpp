// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/distance_field.hpp"
#include "palpable/sculpt/correction/field_update.hpp"
#include "palpable/sculpt/correction/surface_correction.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/smooth_surface.hpp"

#include <optional>

namespace palpable::sculpt {

/// A field and the predicted surface that it is corrected by. Pass it by std::move: a copy costs more than a
/// small correction.
struct CorrectedField {
  models::DistanceField field;
  CorrectedSurface surface;
  /// The corrected surface as a distance source: made by the first correction, updated by the later ones.
  std::optional<SmoothSurface> solid = std::nullopt;
  /// Whether the last correction could not be applied to a part of the field, so that the whole field was
  /// sampled again: the corrected surface left the grid, or the field far from the surface no longer matches
  /// it.
  bool rebuilt = false;
};

/// What the last correction changed in the solid of a field whose cells have the side `cell_m`. The change
/// is limited to the neighbourhood of the measured surface: the transition, the greatest displacement and
/// two cells. It is unlimited if the surface moved by more than half of that or nothing was measured.
SolidChange change_of(const CorrectedSurface& surface, double cell_m, const CorrectionOptions& options);

/// Force-field correction of Moustakas et al. 2007: the surface moves onto the measured one
/// (correct_surface()), and only cells of options.volume whose nearest triangle changed are sampled again;
/// the others stay identical bit by bit. `before.surface` is the surface of `before.field`, predicted or
/// already corrected. Errors: as correct_surface() and field_from_source().
Result<CorrectedField> corrected_field(CorrectedField before, const Mesh& measured,
                                       const CorrectionOptions& correction, const FieldOptions& options,
                                       const Work& work);

}  // namespace palpable::sculpt
