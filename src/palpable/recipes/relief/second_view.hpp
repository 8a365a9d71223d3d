// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/models/scene/second_view.hpp"

namespace palpable::recipes {

/// The right picture of a rectified pair as the right eye's view of the relief of its left one, with the left
/// one's levels if the exposures differ.
/// `disparity_px`: of the left picture, x_left - x_right; NaN where it is unknown. Known at one pixel at
/// least.
models::SecondView second_view(const Image& left, const Image& right, Raster<float> disparity_px);

}  // namespace palpable::recipes
