// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <memory>
#include <span>

namespace palpable::sculpt {

/// The union of superquadrics (at least one): Moustakas 2007's predicted field. Exact outside, and inside
/// where only one contains the point; where several do, the depth in the deepest one
/// (models/field/superquadric_distance.hpp). Errors: invalid_input, as models::check_superquadric().
Result<std::unique_ptr<DistanceSource>> distance_of(std::span<const models::Superquadric> shapes);

}  // namespace palpable::sculpt
