// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <vector>

namespace palpable::vision {

/// The same point in both pictures, pixels.
struct FeatureMatch {
  double left_x, left_y;
  double right_x, right_y;
};

/// Scale-invariant features found in both pictures, mutual and distinct (in copies at most 1600 pixels long);
/// some of them wrong. The same for the same pictures.
std::vector<FeatureMatch> match_features(const StereoPair& pair);

/// How far a right match may lie from where it should, in pixels.
double feature_tolerance_px(int width, int height);

/// RMS of y_left - y_right in pixels; NaN without matches.
double vertical_rms_px(const std::vector<FeatureMatch>& matches);

}  // namespace palpable::vision
