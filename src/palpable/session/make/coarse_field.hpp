// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"

#include <optional>

namespace palpable::session {

/// The coarse field with which the touch of a mesh begins while the requested field is computed. The defaults
/// were chosen for a first touch of a mesh of 100 000 triangles after about 4 s of processor time, most of
/// which runs on two cores (docs/history/2026-11-23-fields.md).
struct CoarseField {
  /// Finest cells along the longest side, 16 ... 512; 0 = no coarse field. Used only if the requested field
  /// has at least twice as many.
  int resolution = 96;
  /// Its error bound, metres; the requested field's bound if that is larger.
  double max_error_m = 0.0001;
  /// Meshes with fewer triangles get no coarse field.
  int least_triangles = 5000;
};

/// The recipe of the coarse field of a mesh whose field `requested` describes; nullopt if the requested field
/// does not take long, or is dense.
std::optional<recipes::FieldRecipe> coarse_recipe(const CoarseField& coarse, const Mesh& mesh,
                                                  const recipes::FieldRecipe& requested);

}  // namespace palpable::session
