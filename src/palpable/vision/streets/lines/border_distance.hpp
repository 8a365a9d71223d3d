// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <cstdint>

#include <opencv2/core.hpp>

namespace palpable::vision {

/// Of each pixel of a mask (not zero) the distance to the nearest pixel outside of it, pixels, in 32-bit
/// floats; 0 outside.
cv::Mat border_distance(const Raster<std::uint8_t>& mask);

}  // namespace palpable::vision
