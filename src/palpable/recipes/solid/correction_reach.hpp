// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/sculpt/correction/surface_correction.hpp"

#include <vector>

namespace palpable::recipes {

/// How far a correction reaches: as far as the prediction is wrong.
struct CorrectionReachOptions {
  /// The reach is this quantile of the distances of the measured points from the predicted surface, 0.5 … 1;
  /// at least so many spacings of samples, 0.5 … 20; at most a share of the extent, 0.001 … 0.5.
  double quantile = 0.95;
  double least_spacings = 3.0;
  double most_share = 0.05;
  /// The width of the transition, in reaches, 1 … 10. The slope of eq. 2 is at most 1.875 reaches over it.
  double transition_reaches = 2.0;
};
/// Their names: reach_quantile, least_reach_spacings, most_reach_share, transition_reaches.
std::vector<Parameter> parameters_of(CorrectionReachOptions& options);

/// Parameters of a correction but those that follow from its reach, which set_reach() sets.
std::vector<Parameter> without_reach(std::vector<Parameter> of_correction);

/// Sets the reach and the transition of `correction` from the distances `residuals` of points, in the unit of
/// the spacing of the samples and of the extent, all metres or all in the unit of a model.
void set_reach(const CorrectionReachOptions& options, std::vector<double> residuals, double spacing,
               double extent, sculpt::CorrectionOptions& correction);

}  // namespace palpable::recipes
