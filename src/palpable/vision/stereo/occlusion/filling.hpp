// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <cstdint>

namespace palpable::vision {

/// Fills each run of untrusted pixels (0 in `trusted`) of a scanline with the lower disparity of the trusted
/// pixels at its two ends, since occluded pixels belong to the background. Rows without a trusted pixel keep
/// their values.
void fill_from_background(const Raster<std::uint8_t>& trusted, Raster<float>& disparity_px);

}  // namespace palpable::vision
