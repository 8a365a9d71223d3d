// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <optional>
#include <string_view>

namespace palpable::sculpt {

/// How a depth map is resampled (Gomez 2012, chapter 10).
enum class Resampling {
  none,
  /// Bilinear between the four samples around: continuous, with creases at the samples.
  bilinear,
  /// By the values, slopes and cross-derivatives of the four samples around (central differences over 4 x
  /// 4): the slope is continuous too; at a step it overshoots by up to 2/27 of it.
  bicubic
};

std::string_view name_of(Resampling resampling);
std::optional<Resampling> resampling_from(std::string_view name);

/// Resamples `values` (all finite, at least 2 x 2) over the same rectangle to width x height samples, each
/// at least 2. Samples are at pixel centres; beyond the border the surface is level. Before a reduction,
/// frequencies above the new sampling rate are removed. `none` requires the same size.
Raster<float> resampled(const Raster<float>& values, int width, int height, Resampling resampling);

}  // namespace palpable::sculpt
