// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/rectification/feature_matches.hpp"

#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// Corners of the left picture tracked into the right one of a pair that is rectified but for some pixels: a
/// dense disparity predicts where they are, which resolves repeated patterns by their surroundings, as single
/// features cannot; then Lucas & Kanade's tracker finds the place in both directions, and only round trips
/// that return count. `known` are matches that agree: they bound the disparities. Pixels of the pictures
/// given. Errors: interrupted.
Result<std::vector<FeatureMatch>> tracked_matches(const StereoPair& nearly_rectified,
                                                  const std::vector<FeatureMatch>& known, const Work& work,
                                                  const CornerTrackingOptions& options = {});

}  // namespace palpable::vision
