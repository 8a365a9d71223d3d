// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>

namespace palpable::recipes {

/// The relief of a scene whose volume is to be filled. Errors: usage for a scene of another kind.
inline Result<std::shared_ptr<const models::Relief>> relief_to_fill(const models::Scene& scene) {
  if (const auto* relief = std::get_if<std::shared_ptr<const models::Relief>>(&scene.model)) return *relief;
  return Error{ErrorCode::usage,
               "fields and grids are filled under a relief, and this is a " + models::kind_of(scene.model),
               {}};
}

}  // namespace palpable::recipes
