// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/problem/exposure_match.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

namespace palpable::vision {

/// The pair as 8-bit planes. The levels of both pictures are stretched by one factor to 0…255. If the
/// exposures differ, the right picture's levels are mapped to the left one's for each colour, and both are
/// clipped where the right one is. A common dark frame of a few lines is replaced by the lines inside it.
/// `disparities` stays 0. `exposure`, if given, receives the difference. Sizes must be equal and not 0.
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
