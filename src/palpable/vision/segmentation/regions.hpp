// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// A picture cut into regions of like colour: each pixel's region, numbered from 0, and each region's pixels.
struct Regions {
  Raster<std::int32_t> of_pixel;
  std::vector<std::int32_t> pixels;
  int count() const { return static_cast<int>(pixels.size()); }
};

/// Statistical region merging (Nock & Nielsen 2004): neighbours are joined in the order of their difference
/// where their mean colours differ by less than chance explains. Greater `complexity` (their Q, 1 … 1024)
/// gives more regions.
Regions merge_regions(const Raster<Rgb8>& picture, double complexity = 32.0);

}  // namespace palpable::vision
