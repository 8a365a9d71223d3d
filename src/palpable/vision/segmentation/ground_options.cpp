// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/ground_options.hpp"

namespace palpable::vision {
std::vector<Parameter> parameters_of(GroundPlaneOptions& o) {
  return {{"searched_samples", &o.searched_samples, {100, 1e6}, "", "pixels that planes are found from"},
          {"fitted_samples", &o.fitted_samples, {100, 1e6}, "", "pixels that planes are refined with"},
          {"trials", &o.trials, {10, 100000}, "", "random triples"},
          {"reach_share", &o.reach_share, {0.01, 2}, "", "reach of a triple over the picture's longer side"},
          {"refined_planes", &o.refined_planes, {1, 100}, "", "planes that are refined"},
          {"tolerance_px", &o.tolerance_px, {0.05, 10}, "px", "inlier tolerance of the search"},
          {"least_rise_px", &o.least_rise_px, {0, 100}, "px", "least rise down the picture"},
          {"least_rise_share", &o.least_rise_share, {0, 1}, "", "least rise over the range of disparities"},
          {"most_roll", &o.most_roll, {0, 10}, "", "greatest slope across over that down"},
          {"under_penalty", &o.under_penalty, {0, 10}, "", "weight of pixels under the plane"},
          {"iterations", &o.iterations, {1, 100}, "", "rounds of the robust fit"},
          {"biweight", &o.biweight, {1, 20}, "", "Tukey's constant"},
          {"least_sigma_px", &o.least_sigma_px, {1e-6, 10}, "px", "least standard deviation"},
          {"most_sigma_px", &o.most_sigma_px, {1e-6, 10}, "px", "greatest standard deviation"},
          {"near_px", &o.near_px, {1e-6, 10}, "px", "farthest pixel that the deviation is estimated from"},
          {"least_share", &o.least_share, {0, 1}, "", "least share of the known pixels"},
          {"least_held_rise_px", &o.least_held_rise_px, {0, 100}, "px", "least rise of the ground's pixels"},
          {"least_held_rise_sigmas", &o.least_held_rise_sigmas, {0, 100}, "", "the same in deviations"}};
}

std::vector<Parameter> parameters_of(GroundMaskOptions& o) {
  return {{"region_complexity", &o.region_complexity, {1, 1024}, "", "complexity of the colour regions"},
          {"sigmas", &o.sigmas, {0.1, 20}, "", "tolerance in standard deviations"},
          {"least_tolerance_px", &o.least_tolerance_px, {0, 10}, "px", "least tolerance"},
          {"neighbourhood_px", &o.neighbourhood_px, {1, 50}, "px", "neighbourhood to each side"},
          {"near_tolerances", &o.near_tolerances, {1, 20}, "", "neighbours that count, in tolerances"},
          {"least_near_px", &o.least_near_px, {0, 10}, "px", "neighbours that count, at least"},
          {"most_rise_share", &o.most_rise_share, {0, 2}, "", "rise of an object's foot over the slope"},
          {"mostly_share", &o.mostly_share, {0, 1}, "", "share of a region that is mostly ground"},
          {"far_px", &o.far_px, {0, 20}, "px", "farthest pixel that such a region takes in"},
          {"majority_px", &o.majority_px, {0, 20}, "px", "half the window of the majority filter"},
          {"border_px", &o.border_px, {1, 100}, "px", "strip at borders in which colour decides"},
          {"hidden_px", &o.hidden_px, {0, 20}, "px", "how much nearer a surface hides"},
          {"far_end_share", &o.far_end_share, {0, 0.5}, "", "pixels beyond the ground's far end"}};
}

std::vector<Parameter> parameters_of(ColourDecisionOptions& o) {
  return {
      {"reach_px", &o.reach_px, {1, 200}, "px", "reach of the comparison"},
      {"step_px", &o.step_px, {1, 16}, "px", "step of the comparison"},
      {"least_pixels", &o.least_pixels, {1, 10000}, "", "least decided pixels"},
      {"colour_scale", &o.colour_scale, {1e-3, 255}, "levels", "scale of colour differences"},
      {"prior_ratio", &o.prior_ratio, {1, 1000}, "", "least likelihood ratio of the other side"},
      {"least_density", &o.least_density, {1e-6, 1}, "", "likelihood of a colour that a side does not have"}};
}

std::vector<Parameter> parameters_of(GroundOptions& o) {
  std::vector<Parameter> all{
      {"least_share", &o.least_share, {0, 1}, "", "least share of the picture that is ground"}};
  append_parameters(all, "plane", parameters_of(o.plane));
  append_parameters(all, "mask", parameters_of(o.mask));
  append_parameters(all, "colour", parameters_of(o.colour));
  return all;
}

}  // namespace palpable::vision
