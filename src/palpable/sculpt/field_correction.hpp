// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/distance_field.hpp"
#include "palpable/sculpt/field_from_source.hpp"
#include "palpable/sculpt/smooth_surface.hpp"
#include "palpable/sculpt/surface_correction.hpp"

#include <optional>

namespace palpable::sculpt {

/// A field and the predicted surface that it is corrected by. Hand it on (std::move): a copy costs more than
/// a small correction.
struct CorrectedField {
  models::DistanceField field;
  CorrectedSurface surface;
  /// The surface as it stands, ready to be asked; made by the first correction, and moved by each.
  std::optional<SmoothSurface> solid = std::nullopt;
  /// Whether the last correction reached out of the field's grid, so that all of it was sampled anew.
  bool sampled_anew = false;
};

/// Force-field correction of Moustakas et al. 2007: the surface goes to what was measured
/// (correct_surface()), and the field is sampled again only in cells where what changed is the nearest; the
/// others stay as they are to the bit. `before.surface` is the field's own, predicted or already corrected.
/// Errors: as correct_surface() and updated_field(): failed where the corrected solid reaches out of the
/// field's grid.
Result<CorrectedField> corrected_field(CorrectedField before, const Mesh& measured,
                                       const CorrectionOptions& correction, const FieldOptions& options,
                                       const Work& work);

}  // namespace palpable::sculpt
