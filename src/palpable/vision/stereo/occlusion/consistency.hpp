// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"

#include <cstdint>
#include <span>

namespace palpable::vision {

/// Marks in `trusted` (1, else 0) the pixels of a left row whose disparity the right picture's row confirms
/// within one pixel at the place it points to. Both rows as long as each other; right_px[x] is the right
/// picture's disparity, x_left = x + right_px[x]; it shows something from column `right_first` on.
void mark_mutual(std::span<const float> left_px, std::span<const float> right_px, int right_first,
                 std::span<std::uint8_t> trusted);

/// Gives each run of untrusted pixels of a scanline the lower disparity of the trusted pixels at its two
/// ends: what one camera cannot see lies behind what hides it. Rows without a trusted pixel stay.
void fill_from_behind(const Raster<std::uint8_t>& trusted, Raster<float>& disparity_px);

}  // namespace palpable::vision
