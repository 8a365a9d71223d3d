// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/contours/contour_options.hpp"

#include <vector>

namespace palpable::vision {

/// The channels that edges are measured in, each with its weight: L, a, b (CIELAB / 100, white D65) of
/// colour, the values themselves of grey. Pictures of more than 8 bits are stretched between two quantiles
/// first; transparent pixels lie on white.
struct WeightedChannel {
  Raster<float> values;
  float weight = 1.0F;
};
std::vector<WeightedChannel> edge_channels(const Image& image, const ChannelOptions& options,
                                           const Work& work);

}  // namespace palpable::vision
