// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

namespace palpable::sculpt {

/// Estimates normals: each is that of the plane fitted to the point and its twelve nearest neighbours
/// (principal components). Signs are propagated from neighbour to neighbour, along the smallest angles first
/// (Hoppe et al. 1992). Then each connected part is oriented so that its normals at the extreme points in 26
/// directions point outwards: outward for a closed surface, away from its middle for an open one. Points at
/// the same place count once. Long work: all threads, polls cancel. Errors: invalid_input for fewer than 16
/// points or one that is not finite; interrupted.
Result<PointCloud> with_normals(PointCloud cloud, const Work& work);

}  // namespace palpable::sculpt
