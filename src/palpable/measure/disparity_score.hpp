// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace palpable::measure {

inline constexpr std::array kBadThresholds_px{0.5, 1.0, 2.0, 4.0};

/// Errors of a disparity map over the pixels where the truth is known and the mask is white.
struct DisparityScore {
  std::size_t pixels = 0;
  /// Fraction of the pixels whose result is known, 0…1.
  double coverage = 0.0;
  /// Percent of the pixels whose error is strictly greater than kBadThresholds_px[i]; unknown counts as bad.
  std::array<double, kBadThresholds_px.size()> bad_percent{};
  /// Root mean square error over the known pixels, in pixels and as percent of the truth's range (maximum
  /// minus minimum over the scored pixels). NaN where nothing is known.
  double rms_px = 0.0;
  double rms_percent_of_range = 0.0;
};

/// `result_px` and `truth_px`: disparities, non-finite = unknown. `mask`: empty (every pixel), or 255 (white)
/// where a pixel counts. Errors: invalid_input for sizes that differ or a truth without a known pixel.
Result<DisparityScore> score_disparity(const Raster<float>& result_px, const Raster<float>& truth_px,
                                       const Raster<std::uint8_t>& mask = {});

}  // namespace palpable::measure
