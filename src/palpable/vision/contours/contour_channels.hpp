// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"

#include <vector>

namespace palpable::vision {

/// The picture's channels as edges are looked for in them, each with its weight: L, a, b (CIELAB / 100, white
/// D65; weights 1, 2, 2) of colour, the values themselves of grey. Deep pictures (more than 8 bits) are
/// stretched between their 0.1st and 99.9th percentile first; transparent pixels lie on white.
struct WeightedChannel {
  Raster<float> values;
  float weight = 1.0F;
};
std::vector<WeightedChannel> edge_channels(const Image& image, const Work& work);

}  // namespace palpable::vision
