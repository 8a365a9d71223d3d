// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/match_input.hpp"

namespace palpable::vision {

/// The pair at half its size (rounded up), each pixel the mean of 2 x 2; half as many disparities.
MatchInput halved(const MatchInput& input);

}  // namespace palpable::vision
