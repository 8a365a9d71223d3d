// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/contours/contour_options.hpp"

#include <vector>

namespace palpable::vision {

/// The channels in which edges are measured, each with its weight: L, a, b (CIELAB / 100, white D65) for
/// colour, the values themselves for grey. Pictures of more than 8 bits are first stretched between two
/// quantiles; transparent pixels are composited on white.
struct WeightedChannel {
  Raster<float> values;
  float weight = 1.0F;
};
std::vector<WeightedChannel> edge_channels(const Image& image, const ChannelOptions& options,
                                           const Work& work);

}  // namespace palpable::vision
