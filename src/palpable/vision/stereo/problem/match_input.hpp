// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/problem/levels.hpp"
#include "palpable/vision/stereo/problem/stereo_method.hpp"

namespace palpable::vision {

/// The pair as 8-bit planes: levels of both pictures stretched by one factor to 0…255, and where the
/// pictures' exposures differ, the right one's levels mapped onto the left one's, colour by colour, and both
/// clipped where the right one is; a dark frame of a few lines that both have is overwritten by the lines
/// inside it. `disparities` is left 0. `exposure`, where given, says how the exposures differ. Sizes must be
/// equal and not 0.
MatchInput prepare_pictures(const StereoPair& pair, const Work& work, Exposure* exposure = nullptr,
                            const PreparationOptions& options = {});

/// The picture moved so that result(x, y) = picture(x - shift_px, y), border columns repeated.
template <class T>
Raster<T> shifted(const Raster<T>& picture, int shift_px) {
  Raster<T> out(picture.width(), picture.height());
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const int from = x - shift_px;
      out(x, y) = picture(from < 0 ? 0 : from >= picture.width() ? picture.width() - 1 : from, y);
    }
  return out;
}

}  // namespace palpable::vision
