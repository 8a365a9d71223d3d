// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/distance_field.hpp"
#include "palpable/sculpt/correction/field_update.hpp"
#include "palpable/sculpt/correction/surface_correction.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/smooth_surface.hpp"

#include <optional>

namespace palpable::sculpt {

/// A field and the predicted surface that it is corrected by. Hand it on (std::move): a copy costs more than
/// a small correction.
struct CorrectedField {
  models::DistanceField field;
  CorrectedSurface surface;
  /// The surface as it stands, ready to be asked; made by the first correction, and moved by each.
  std::optional<SmoothSurface> solid = std::nullopt;
  /// Whether the last correction could not be followed in part, so that all of the field was sampled anew: it
  /// reached out of the grid, or the field no longer fits the solid far from the surface.
  bool sampled_anew = false;
};

/// What the last correction of a surface changed of its solid, in a field of cells that long. Near what was
/// measured means: no farther than the transition, the longest way that the surface moved now and two cells;
/// where the surface moved by more than half of that, and where nothing was measured, everywhere.
SolidChange change_of(const CorrectedSurface& surface, double cell_m, const CorrectionOptions& options);

/// Force-field correction of Moustakas et al. 2007: the surface goes to what was measured
/// (correct_surface()), and the field is sampled again only in cells of options.volume where what changed is
/// the nearest; the others stay as they are to the bit. `before.surface` is the field's own, predicted or
/// already corrected. Errors: as correct_surface() and field_from_source().
Result<CorrectedField> corrected_field(CorrectedField before, const Mesh& measured,
                                       const CorrectionOptions& correction, const FieldOptions& options,
                                       const Work& work);

}  // namespace palpable::sculpt
