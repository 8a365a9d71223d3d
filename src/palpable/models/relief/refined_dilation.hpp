// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/models/relief/refined_relief.hpp"
#include "palpable/models/relief/relief.hpp"

#include <memory>

namespace palpable::models {

/// Dilates a relief by a ball, as dilate_by_ball(), and refines the cells that its pixels cannot represent:
/// the creases where the ball touches two walls. The surface is within 5 um of the Minkowski sum of relief
/// and ball up to slope 3, where a crease has fine pixels of at most 12.5 um. At most four million fine
/// heights are computed, so reliefs with creases nearly everywhere, and those with pixels above 0.8 mm, get
/// coarser ones. 0 < radius_m <= 0.02.
std::shared_ptr<const RefinedRelief> dilate_finely_by_ball(const Relief& relief, double radius_m,
                                                           const Work& work);

}  // namespace palpable::models
