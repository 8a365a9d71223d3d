// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <cstdint>
#include <span>

// The left-right check: a disparity is confirmed if the other view's disparity at the match agrees with it.
namespace palpable::vision {

/// Disparities of the two views that differ by at most this agree; px.
inline constexpr float kLeftRightTolerance_px = 1.0F;

/// 1 where the other view's disparity at the match (x - d, y) is within kLeftRightTolerance_px of d, else 0.
/// `other` is in its own picture's frame: the match of its pixel x is at x + d here.
Raster<float> left_right_check(const Raster<float>& disparity, const Raster<float>& other);

/// The same for one row: sets `confirmed` to 1 or 0. All rows have the same length. right_px[x] is the right
/// picture's disparity, x_left = x + right_px[x]; it has content from column `right_first` on.
void left_right_check_row(std::span<const float> left_px, std::span<const float> right_px, int right_first,
                          std::span<std::uint8_t> confirmed);

/// Sets disparities before the column `first`, where the other picture has no content, to infinity, so that
/// they confirm nothing and occlude everything.
void mask_columns_before(int first, Raster<float>& other);

/// The quantile `at` of the values whose weight is above 0; 0 if there are none.
float quantile_where(const Raster<float>& values, const Raster<float>& weight, double at);

}  // namespace palpable::vision
