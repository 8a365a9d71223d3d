// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <opencv2/core.hpp>

// Inside vision's sources only.
namespace palpable::vision {

/// How much of each pixel lettering of the colour `ink` covers, 0 ... 255. A pixel is taken for a mixture of
/// the ink and of the ground, which is the lightest colour within `stroke_px`; pixels whose colour differs
/// from all such mixtures by `tolerance` (RGB levels) count half, by twice as much nothing: borders in
/// another colour vanish.
cv::Mat coverage_of(const Raster<Rgb8>& picture, Rgb8 ink, int stroke_px, double tolerance);

}  // namespace palpable::vision
