// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

namespace palpable::draw {

/// Dark blue (0) through green to pale yellow (1), lightness rising evenly in Oklab (Ottosson 2020), so that
/// equal steps look equal, also in grey and to colour-blind eyes. `t` is clamped to 0…1.
Rgb8 depth_colour(double t);

/// The same order of hues, pale and muted: a tint under hill shading. `t` is clamped to 0…1.
Rgb8 tint_colour(double t);

/// Oklab lightness of a colour, 0…1.
double lightness(Rgb8 colour);

}  // namespace palpable::draw
