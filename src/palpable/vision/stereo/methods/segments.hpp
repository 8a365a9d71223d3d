// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo_method.hpp"

namespace palpable::vision {

/// Hong & Chen's method as Gomez describes it: planes for segments of one colour, chosen by graph cuts.
Result<MatchOutput> match_segments(const MatchInput& input, const StereoOptions& options, const Work& work);

}  // namespace palpable::vision
