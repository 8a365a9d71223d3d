// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/detail_options.hpp"

namespace palpable::sculpt {

std::vector<Parameter> parameters_of(GradientDomainOptions& o) {
  return {{"least_step_m", &o.least_step_m, {0.0, 0.02}, "m", "least height of a silhouette's ramp"},
          {"greatest_step_m", &o.greatest_step_m, {0.0, 0.02}, "m", "greatest height of a silhouette's ramp"},
          {"step_least_share", &o.step_least_share, {0.0, 1.0}, "", "least share of a silhouette's step"},
          {"step_greatest_share",
           &o.step_greatest_share,
           {1.0, 100.0},
           "",
           "greatest share of a silhouette's step"},
          {"step_window_px", &o.step_window_px, {1, 31}, "px", "window in which steps add up"},
          {"step_reach_px", &o.step_reach_px, {0, 32}, "px", "pixels around a step in which it counts"},
          {"silhouette_slope",
           &o.silhouette_slope,
           {1.0, 20.0},
           "",
           "slope of a silhouette over the slope limit"},
          {"silhouette_weight", &o.silhouette_weight, {0.0, 1.0}, "", "weight of a silhouette's difference"},
          {"gain_scale",
           &o.gain_scale,
           {0.0, 1.0},
           "",
           "scale on which steepness decides the gain, share of the longer side"},
          {"detail_scale",
           &o.detail_scale,
           {0.0, 1.0},
           "",
           "scale below which forms are detail, share of the longer side"},
          {"detail_gain", &o.detail_gain, {0.0, 1.0}, "", "share of its height that detail keeps"},
          {"unfelt_slope", &o.unfelt_slope, {0.0, 1.0}, "", "slope below which nothing is felt"},
          {"relaxation", &o.relaxation, {1.0, 2.0}, "", "over-relaxation of each round"},
          {"rounds", &o.rounds, {1, 1000}, "", "rounds of the solver"},
          {"correction_interval",
           &o.correction_interval,
           {1, 1000},
           "",
           "rounds between corrections of the gain"},
          {"last_corrected_round",
           &o.last_corrected_round,
           {0, 1000},
           "",
           "last round in which the gain is corrected"}};
}

std::vector<Parameter> parameters_of(ChiuOptions& o) {
  return {
      {"mean_scale", &o.mean_scale, {0.0, 1.0}, "", "deviation of the local mean, share of the longer side"}};
}

std::vector<Parameter> parameters_of(AshikhminOptions& o) {
  return {
      {"contrast", &o.contrast, {0.0, 1.0}, "", "difference of means up to which a window grows"},
      {"greatest_window_px", &o.greatest_window_px, {1.0, 256.0}, "px", "deviation of the largest window"},
      {"window_factor", &o.window_factor, {1.05, 4.0}, "", "factor from one window to the next"}};
}

std::vector<Parameter> parameters_of(BilateralOptions& o) {
  return {{"range", &o.range, {0.001, 1.0}, "", "deviation of the nearness"},
          {"spatial_scale",
           &o.spatial_scale,
           {0.0, 1.0},
           "",
           "deviation in the picture, share of the longer side"},
          {"base_exponent", &o.base_exponent, {0.1, 1.0}, "", "exponent of the base's curve"}};
}

std::vector<Parameter> parameters_of(HistogramOptions& o) {
  return {{"bins", &o.bins, {16, 65536}, "", "bins of the histogram"},
          {"linear_share", &o.linear_share, {0.0, 1.0}, "", "share of the linear mapping"}};
}

std::vector<Parameter> parameters_of(DetailOptions& o) {
  std::vector<Parameter> all;
  append_parameters(all, "relief", parameters_of(o.relief));
  append_parameters(all, "chiu", parameters_of(o.chiu));
  append_parameters(all, "ashikhmin", parameters_of(o.ashikhmin));
  append_parameters(all, "bilateral", parameters_of(o.bilateral));
  append_parameters(all, "histogram", parameters_of(o.histogram));
  return all;
}

}  // namespace palpable::sculpt
