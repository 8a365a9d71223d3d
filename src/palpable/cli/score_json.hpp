// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/measure/disparity_score.hpp"
#include "palpable/measure/disparity_touch.hpp"

namespace palpable::cli {

/// All that is measured of a disparity map against its truth.
struct DisparityScores {
  measure::DisparityScore pixels;
  /// NaN where the truth is too plain to make a relief of.
  measure::DisparityTouch touch;
};

/// Errors: as measure::score_disparity().
Result<DisparityScores> scores_of(const Raster<float>& result_px, const Raster<float>& truth_px,
                                  const Raster<std::uint8_t>& mask);

/// As the command line's contract names the fields; what is not a number is null.
Json json_of(const DisparityScores& scores);

/// Share of the pixels whose value is finite, 0 … 1.
double coverage_of(const Raster<float>& disparity_px);

}  // namespace palpable::cli
