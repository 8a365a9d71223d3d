// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::draw {

/// Lambertian hill shading by a light from the upper left at 45 degrees elevation, about half of it ambient.
/// Slopes are exaggerated twice, as usual on maps. About 0.45 ... 1.2.
double shade_of(const models::HeightSample& sample);

/// A colour multiplied by a shade.
Rgb8 shaded(Rgb8 colour, double shade);

/// The whole relief from above, tinted by height and shaded, at this size.
Raster<Rgb8> shaded_relief(const models::Relief& relief, int width_px, int height_px);

}  // namespace palpable::draw
