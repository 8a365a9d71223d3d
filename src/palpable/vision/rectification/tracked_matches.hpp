// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/rectification/feature_matches.hpp"

#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// Tracks corners from the left picture to the right one of a pair that is rectified up to some pixels. A
/// dense disparity map predicts their positions; unlike single features, it resolves repeated patterns by
/// their surroundings. Then Lucas & Kanade's tracker runs in both directions, and only consistent round trips
/// count. `known` are inlier matches, which bound the disparities. Coordinates are in pixels of the given
/// pictures. Errors: interrupted.
Result<std::vector<FeatureMatch>> tracked_matches(const StereoPair& nearly_rectified,
                                                  const std::vector<FeatureMatch>& known, const Work& work,
                                                  const CornerTrackingOptions& options = {});

}  // namespace palpable::vision
