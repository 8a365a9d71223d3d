// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/vision/rectification/stereo_rectification_options.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <vector>

namespace palpable::vision {

/// The same point in both pictures, pixels.
struct FeatureMatch {
  double left_x, left_y;
  double right_x, right_y;
};

/// SIFT features found in both pictures, mutual and distinct; some of them wrong. Deterministic.
std::vector<FeatureMatch> match_features(const StereoPair& pair, const FeatureMatchOptions& options = {});

/// The inlier tolerance in pixels of pictures of this size.
double feature_tolerance_px(int width, int height, const FeatureMatchOptions& options = {});

/// RMS of y_left - y_right in pixels; NaN without matches.
double vertical_rms_px(const std::vector<FeatureMatch>& matches);

}  // namespace palpable::vision
