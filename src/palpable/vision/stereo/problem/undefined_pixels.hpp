// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo.hpp"

#include <cstdint>

namespace palpable::vision {

/// 1 where a sample of a pixel (alpha aside) is not a finite number, as float files and warped pictures may
/// have. Matching sees such pixels as black.
Raster<std::uint8_t> undefined_pixels(const Image& picture);

/// Errors: invalid_input for a pair of which one picture has no pixel of finite numbers.
Result<void> check_any_defined(const StereoPair& pair);

/// Makes the disparities unknown, with confidence 0, of undefined pixels of the left picture and of those
/// that match an undefined pixel of the right one.
void forget_undefined(const StereoPair& pair, StereoMatch& match);

}  // namespace palpable::vision
