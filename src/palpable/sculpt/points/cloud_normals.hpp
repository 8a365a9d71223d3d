// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/point_cloud.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

namespace palpable::sculpt {

/// Normals of points that have none: across the plane that fits each point and its twelve nearest
/// neighbours best (principal components), all turned to one side of the surface from neighbour to
/// neighbour, first where they bend least (Hoppe et al. 1992); then each part that hangs together is turned
/// so that its extreme places in 26 directions face outwards. Of a closed surface that is outward; of an open
/// one, away from its middle. Points at the same place count once. Long work: all threads, polls
/// cancel. Errors: invalid_input for fewer than 16 points or one that is not finite; interrupted.
Result<PointCloud> with_normals(PointCloud cloud, const Work& work);

}  // namespace palpable::sculpt
