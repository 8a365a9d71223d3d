// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::draw {

/// Lambert's shading by a light from the upper left, 45 degrees high, half of it ambient; slopes count
/// double, as map makers do. About 0.45 ... 1.2.
double shade_of(const models::HeightSample& sample);

/// A colour made darker or lighter.
Rgb8 shaded(Rgb8 colour, double shade);

/// The whole relief from above, tinted by height and shaded, at this size.
Raster<Rgb8> shaded_relief(const models::Relief& relief, int width_px, int height_px);

}  // namespace palpable::draw
