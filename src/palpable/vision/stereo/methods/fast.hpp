// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo_method.hpp"

namespace palpable::vision {

/// The method `fast`, for live use: AD-Census costs averaged over small crosses, semi-global matching over
/// four paths, the right view read from the same sums, hidden pixels filled from behind, a median against
/// specks. Gives a confidence of 0 or 1: whether both views agree; no pixel is left unknown.
Result<MatchOutput> match_fast(const MatchInput& input, const StereoOptions& options, const Work& work);

}  // namespace palpable::vision
