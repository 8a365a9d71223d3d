// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"

#include <vector>

namespace palpable::sculpt {

// Parameters of the detail operators (detail.hpp). parameters_of() gives the ranges.

/// Of DetailOperator::relief. Its defaults were chosen by the measures of `score relief` on stereo pairs with
/// known depth (docs/relief.md); the record does not say on which.
struct GradientDomainOptions {
  /// Height of a silhouette's ramp: at least the first, growing with the gain of the smooth surface up to the
  /// second; 0 ... 20 mm.
  double least_step_m = 0.0006;
  double greatest_step_m = 0.0030;
  /// If differences are inconsistent around a loop, a silhouette's step may change to between these shares
  /// of its size; 0 … 1 and 1 … 100.
  double step_least_share = 0.3;
  double step_greatest_share = 6.0;
  /// Steps within this window add up (1 … 31 px), and count within this distance (0 … 32 px).
  int step_window_px = 5;
  int step_reach_px = 6;
  /// A silhouette is steeper than this multiple of the slope limit; 1 … 20.
  double silhouette_slope = 2.0;
  /// Weight of a silhouette's difference in the least-squares solution; others have 1. 0 ... 1.
  double silhouette_weight = 0.05;
  /// Shares of the picture's longer side, 0 ... 1: over the first, steepness decides the gain; forms narrower
  /// than the second are detail.
  double gain_scale = 0.08;
  double detail_scale = 0.04;
  /// Detail keeps this share of its height if the order of heights allows it; 0 … 1.
  double detail_gain = 0.30;
  /// Slopes below this are not felt (rise over run): if the scene has no steeper slope nearby, the relief
  /// may slope as much either way. 0 … 1.
  double unfelt_slope = 0.02;
  /// Over-relaxation of each round, 1 ... 2, and the number of rounds, 1 ... 1000.
  double relaxation = 1.6;
  int rounds = 28;
  /// The gain is adjusted to the wanted height every n rounds (1 … 1000), until this round (0 … 1000).
  int correction_interval = 4;
  int last_corrected_round = 20;
};

/// Of DetailOperator::chiu: the local mean's standard deviation as a share of the longer side, 0 ... 1.
struct ChiuOptions {
  double mean_scale = 0.03;
};

/// Of DetailOperator::ashikhmin: windows grow by a factor while their mean changes by less than a contrast.
struct AshikhminOptions {
  /// Of nearness, 0 ... 1.
  double contrast = 0.02;
  /// Standard deviation of the largest window, 1 ... 256 px, and the factor from one to the next, 1.05 ... 4.
  double greatest_window_px = 16.0;
  double window_factor = 1.6;
};

/// Of DetailOperator::bilateral.
struct BilateralOptions {
  /// Standard deviations: of nearness, 0.001 ... 1; and in the picture, as a share of its longer side, 0
  /// ... 1.
  double range = 0.1;
  double spatial_scale = 0.01;
  /// Exponent of the curve that compresses the base, 0.1 ... 1: below 1, near parts get more height.
  double base_exponent = 0.8;
};

/// Of DetailOperator::histogram.
struct HistogramOptions {
  /// 16 ... 65536.
  int bins = 4096;
  /// Share of the plain linear mapping in the result, 0 ... 1, so that a level that fills half of the picture
  /// does not open a gap.
  double linear_share = 0.2;
};

struct DetailOptions {
  GradientDomainOptions relief;
  ChiuOptions chiu;
  AshikhminOptions ashikhmin;
  BilateralOptions bilateral;
  HistogramOptions histogram;
};

std::vector<Parameter> parameters_of(GradientDomainOptions& options);
std::vector<Parameter> parameters_of(ChiuOptions& options);
std::vector<Parameter> parameters_of(AshikhminOptions& options);
std::vector<Parameter> parameters_of(BilateralOptions& options);
std::vector<Parameter> parameters_of(HistogramOptions& options);
std::vector<Parameter> parameters_of(DetailOptions& options);

}  // namespace palpable::sculpt
