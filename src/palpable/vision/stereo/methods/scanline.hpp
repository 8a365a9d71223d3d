// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo_method.hpp"

namespace palpable::vision {

/// What the paths of all scanlines say, before anything is filled or smoothed.
struct ScanlineMap {
  Raster<float> disparity_px;
  /// 1 where both cameras see the pixel and the right picture's path agrees.
  Raster<std::uint8_t> trusted;
};

/// The paths alone; other methods begin with them. Half done when the work was cancelled.
ScanlineMap scanline_map(const MatchInput& input, const Work& work);

}  // namespace palpable::vision
