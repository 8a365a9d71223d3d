// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"

namespace palpable::vision {

/// The median of each 3 x 3 neighbourhood; the border keeps its values.
Raster<float> median_3x3(const Raster<float>& values, const Work& work);

}  // namespace palpable::vision
