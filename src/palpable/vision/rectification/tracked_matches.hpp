// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/rectification/feature_matches.hpp"

#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// Corners of the left picture followed into the right one of a pair that shares scanlines but for some
/// pixels: a dense disparity says where they are about, which tells repeated patterns apart by what lies
/// around them, as single features cannot; then Lucas & Kanade's tracker finds the place in both directions,
/// and only what it leads back from counts. `known` are matches that agree: they tell where disparities lie.
/// Pixels of the pictures given. Errors: interrupted.
Result<std::vector<FeatureMatch>> tracked_matches(const StereoPair& nearly_aligned,
                                                  const std::vector<FeatureMatch>& known, const Work& work);

}  // namespace palpable::vision
