// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/measure/disparity_score.hpp"
#include "palpable/measure/disparity_touch.hpp"

namespace palpable::cli {

/// All scores of a disparity map against its ground truth.
struct DisparityScores {
  measure::DisparityScore pixels;
  /// NaN if the truth has too little relief.
  measure::DisparityTouch touch;
};

/// Errors: as measure::score_disparity().
Result<DisparityScores> scores_of(const Raster<float>& result_px, const Raster<float>& truth_px,
                                  const Raster<std::uint8_t>& mask);

/// The scores as JSON (docs/cli.md); values that are not numbers are null.
Json json_of(const DisparityScores& scores);

/// Share of the pixels whose value is finite, 0 … 1.
double coverage_of(const Raster<float>& disparity_px);

}  // namespace palpable::cli
