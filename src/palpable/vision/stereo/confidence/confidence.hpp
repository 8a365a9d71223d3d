// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// A disparity of less confidence is a guess: inferred from its surroundings, not measured.
inline constexpr float kGuessedBelow = 0.5F;

/// What the pictures and the result say for and against each disparity, the same for every method.
struct MatchEvidence {
  /// match_margin().margin.
  Raster<float> margin;
  /// How much the disparity exceeds the least one within 6 px, beyond 1 px: 0 … 4 px. Beside a farther
  /// surface it may belong to that one.
  Raster<float> above_px;
  /// The distance to the nearest measured pixel, 0 … 60 px. Measured: the margin is above 2, the cost below
  /// 30, and no nearer surface of the result hides the pixel from the other camera.
  Raster<float> distance_px;
  /// 1 where a nearer surface of the result hides the pixel from the other camera, or the match is outside
  /// its picture.
  Raster<std::uint8_t> hidden;
};
MatchEvidence match_evidence(const MatchInput& input, const Raster<float>& disparity_px, const Work& work);

/// The logistic regression of "right within 1 px" on the evidence. Fitted on seeds 1 and 2 of the seventeen
/// kinds of rendered scenes and the results of `fast`, `segments` and `best` together (docs/stereo.md).
struct ConfidenceOptions {
  double constant = 2.293;
  /// For each unit of the margin, within ±10; and more for each above 2.
  double margin = 0.043;
  double margin_above_2 = 0.248;
  /// For each px of above_px.
  double above = -0.4235;
  /// For each unit of ln(1 + distance); and more for each above 1.5.
  double distance = -0.267;
  double distance_above_1_5 = -1.378;
};
std::vector<Parameter> parameters_of(ConfidenceOptions& options);

/// The confidence of each disparity of a result in the frame of `input`: about the share of such disparities
/// that is right within 1 px on the scenes of ConfidenceOptions, and half of it where only one camera saw the
/// pixel, so that it counts as a guess; 0 where it is unknown. Not a probability on other pictures.
Raster<float> confidence_of(const MatchInput& input, const Raster<float>& disparity_px,
                            const ConfidenceOptions& options, const Work& work);

}  // namespace palpable::vision
