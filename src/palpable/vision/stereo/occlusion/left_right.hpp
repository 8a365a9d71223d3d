// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"

namespace palpable::vision {

/// 1 where the other view's disparity at the match (x - d, y) is within a pixel of d, else 0. `other` is in
/// its own picture's frame: the match of its pixel x lies at x + d here.
Raster<float> agreement(const Raster<float>& disparity, const Raster<float>& other);

/// The other picture shows nothing before the column `first`: its disparities there become infinite, so that
/// they agree with none and hide whatever points there.
void hide_before(int first, Raster<float>& other);

/// The value below which the fraction `at` of the values lie whose weight is above 0; 0 where there is none.
float quantile_where(const Raster<float>& values, const Raster<float>& weight, double at);

}  // namespace palpable::vision
