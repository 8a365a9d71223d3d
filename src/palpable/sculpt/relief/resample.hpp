// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"

#include <optional>
#include <string_view>

namespace palpable::sculpt {

/// How a map of depths gets another number of samples (Gomez 2012, chapter 10).
enum class Resampling {
  none,
  /// Straight between the four samples around: continuous, with creases at each of them.
  bilinear,
  /// By the values, slopes and cross-derivatives of the four samples around (central differences over 4 x 4):
  /// the slope is continuous too; at a step it swings over by up to 2/27 of it.
  bicubic
};

std::string_view name_of(Resampling resampling);
std::optional<Resampling> resampling_from(std::string_view name);

/// `values` (all finite, at least 2 x 2) over the same rectangle with width x height samples, each at
/// least 2. Samples stand at the middles of their pixels; the border goes on level. Where there become fewer,
/// what is finer than the new samples is smoothed away first. `none` needs the size it has.
Raster<float> resampled(const Raster<float>& values, int width, int height, Resampling resampling);

}  // namespace palpable::sculpt
