// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/models/relief/refined_relief.hpp"
#include "palpable/models/relief/relief.hpp"

#include <memory>

namespace palpable::models {

/// Dilates a relief by a ball, as dilate_by_ball(), and refines the cells that its pixels cannot
/// represent: the creases where the ball touches two walls. There the surface is within 5 um of the
/// Minkowski sum of relief and ball, along the walls' normals, up to slope 3 and for pixels up to 0.3 mm. A
/// relief in which more than about 4000 cells would need it is not refined. 0 < radius_m <= 0.02.
std::shared_ptr<const RefinedRelief> dilate_finely_by_ball(const Relief& relief, double radius_m,
                                                           const Work& work);

}  // namespace palpable::models
