// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// A picture divided into regions of similar colour: each pixel's region, numbered from 0, and each region's
/// number of pixels.
struct Regions {
  Raster<std::int32_t> of_pixel;
  std::vector<std::int32_t> pixels;
  int count() const { return static_cast<int>(pixels.size()); }
};

/// Statistical region merging (Nock & Nielsen 2004): neighbours are merged in the order of their difference
/// if their mean colours do not differ significantly. A larger `complexity` (their Q, 1 … 1024) gives more
/// regions.
Regions merge_regions(const Raster<Rgb8>& picture, double complexity = 32.0);

}  // namespace palpable::vision
