// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/vision/stereo/problem/stereo_method.hpp"

#include <cstddef>

namespace palpable::vision {

/// About how much memory matching takes beside the program itself, in bytes: a part per pixel and one per
/// pixel and disparity, as the resident memory of the program was measured for each method (0.2 and 0.8
/// megapixels, 64 and 160 disparities; docs/history/2026-11-22-robustness.md). `disparities` at least 1.
double matching_memory_bytes(StereoMethod method, int width, int height, int disparities);

/// Whether so much is available. Errors (failed): it is not, with the size of pictures of this shape that
/// would fit.
Result<void> check_matching_memory(StereoMethod method, int width, int height, int disparities,
                                   std::size_t available_bytes);

}  // namespace palpable::vision
