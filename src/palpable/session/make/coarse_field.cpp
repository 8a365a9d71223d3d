// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/coarse_field.hpp"

#include <algorithm>
#include <cstddef>

namespace palpable::session {

std::optional<recipes::FieldRecipe> coarse_recipe(const CoarseField& coarse, const Mesh& mesh,
                                                  const recipes::FieldRecipe& requested) {
  const bool is_slow = coarse.resolution > 0 &&
                       mesh.triangles.size() >= static_cast<std::size_t>(coarse.least_triangles) &&
                       requested.field.resolution >= 2 * coarse.resolution &&
                       requested.storage == recipes::FieldStorage::adaptive;
  if (!is_slow) return std::nullopt;
  recipes::FieldRecipe recipe = requested;
  recipe.surface = recipes::SolidSurface::given;
  recipe.field.resolution = coarse.resolution;
  recipe.field.max_error_m = std::max(requested.field.max_error_m, coarse.max_error_m);
  return recipe;
}

}  // namespace palpable::session
