// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/stereo_rectification_options.hpp"

#include <string>

namespace palpable::vision {
namespace {

std::vector<Parameter> parameters_of(FeatureMatchOptions& o) {
  return {{"longest_px", &o.longest_px, {200, 10000}, "px", "longest copy in which features are detected"},
          {"most_features", &o.most_features, {50, 100000}, "", "most features of a picture"},
          {"ratio", &o.ratio, {0.1, 1}, "", "Lowe's ratio"},
          {"few_levels", &o.few_levels, {0, 1}, "", "share of the range below which a picture is stretched"},
          {"most_gain", &o.most_gain, {1, 64}, "", "greatest stretch"},
          {"tolerance_px", &o.tolerance_px, {0.1, 20}, "px", "greatest distance of a match from its row"}};
}

std::vector<Parameter> parameters_of(CornerTrackingOptions& o) {
  return {
      {"longest_px", &o.longest_px, {100, 10000}, "px", "longest copy in which corners are tracked"},
      {"most_corners", &o.most_corners, {10, 100000}, "", "most corners of a picture"},
      {"corner_quality", &o.corner_quality, {0.0001, 1}, "", "quality of a corner over the best one's"},
      {"spacing_px", &o.spacing_px, {1, 100}, "px", "least distance of two corners"},
      {"corners_across", &o.corners_across, {2, 10000}, "", "most corners beside each other"},
      {"window_px", &o.window_px, {3, 63}, "px", "tracking window"},
      {"pyramid_levels", &o.pyramid_levels, {0, 6}, "", "pyramid levels of the tracker"},
      {"disparity_longest_px", &o.disparity_longest_px, {100, 2000}, "px", "longest copy for the disparity"},
      {"outer_share", &o.outer_share, {0, 0.4}, "", "outermost matches that may be wrong"},
      {"margin_far_share", &o.margin_far_share, {0, 1}, "", "far margin of the disparities over their span"},
      {"margin_near_share",
       &o.margin_near_share,
       {0, 1},
       "",
       "near margin of the disparities over the width"},
      {"margin_px", &o.margin_px, {0, 50}, "px", "margin of the disparities"},
      {"template_half_px", &o.template_half_px, {2, 50}, "px", "half the template of alternatives"},
      {"band_half_px", &o.band_half_px, {2, 50}, "px", "half the band of rows of alternatives"},
      {"most_alternatives", &o.most_alternatives, {0, 20}, "", "most alternatives of a corner"},
      {"reach_share", &o.reach_share, {0, 1}, "", "reach of alternatives over the width"},
      {"least_correlation", &o.least_correlation, {0, 1}, "", "least correlation of an alternative"},
      {"least_of_best", &o.least_of_best, {0, 1}, "", "least correlation over the best one's"},
      {"round_trip_px", &o.round_trip_px, {0.01, 100}, "px", "greatest error of tracking there and back"},
      {"most_drift_px", &o.most_drift_px, {0.01, 100}, "px", "greatest distance from the prediction"},
      {"apart_px", &o.apart_px, {0.01, 100}, "px", "least distance of alternatives"}};
}

std::vector<Parameter> parameters_of(RotationSearchOptions& o) {
  std::vector<Parameter> all{
      {"trials", &o.trials, {10, 100000}, "", "random samples"},
      {"refined_starts", &o.refined_starts, {1, 100}, "", "best samples that are refined"},
      {"scored_matches", &o.scored_matches, {10, 100000}, "", "matches that a sample is scored on"},
      {"most_rotation", &o.most_rotation, {0.01, 1.5}, "rad", "greatest rotation of a sample"},
      {"least_matches", &o.least_matches, {8, 1000}, "", "least matches of a solution"},
      {"simple_matches_share", &o.simple_matches_share, {0, 1}, "", "matches of a simpler model"},
      {"simple_residual_ratio", &o.simple_residual_ratio, {1, 10}, "", "residual of a simpler model"},
      {"simple_residual_share", &o.simple_residual_share, {0, 1}, "", "its residual over the tolerance"},
      {"least_for_distortion", &o.least_for_distortion, {8, 100000}, "", "matches that distortion needs"},
      {"rough_tolerance", &o.rough_tolerance, {1, 20}, "", "tolerance of a rough estimate"}};
  for (std::size_t i = 0; i < o.round_tolerances.size(); ++i)
    all.push_back({"round_tolerances." + std::to_string(i),
                   &o.round_tolerances[i],
                   {1, 10},
                   "",
                   "inlier tolerance of a refinement round"});
  for (std::size_t i = 0; i < o.prior_px.size(); ++i)
    all.push_back({"prior_px." + std::to_string(i), &o.prior_px[i], {0.001, 1e6}, "px", "weight of a prior"});
  return all;
}

std::vector<Parameter> parameters_of(VerticalOffsetOptions& o) {
  return {{"controls_across", &o.controls_across, {4, 64}, "", "control values across the picture"},
          {"controls_down", &o.controls_down, {4, 64}, "", "control values down the picture"},
          {"least_matches", &o.least_matches, {4, 100000}, "", "least matches of a surface"},
          {"smoothness", &o.smoothness, {0, 100}, "", "weight of smoothness"},
          {"first_scale_px", &o.first_scale_px, {0.01, 100}, "px", "first scale of the robust weights"},
          {"last_scale_px", &o.last_scale_px, {0.01, 100}, "px", "last scale of the robust weights"},
          {"scale_factor", &o.scale_factor, {0.1, 0.99}, "", "factor from scale to scale"},
          {"more_matches", &o.more_matches, {1, 10}, "", "matches over those of the rotations"},
          {"less_residual", &o.less_residual, {0, 1}, "", "residual over that of the rotations"},
          {"good_residual_px", &o.good_residual_px, {0, 10}, "px", "residual that needs no surface"},
          {"least_offset_px", &o.least_offset_px, {0, 100}, "px", "least offset worth a surface"}};
}

}  // namespace

std::vector<Parameter> parameters_of(StereoRectificationOptions& o) {
  std::vector<Parameter> all{
      {"rectified_px", &o.rectified_px, {0, 10}, "px", "residual of a pair that counts as rectified"},
      {"rectified_matches_share", &o.rectified_matches_share, {0.1, 1}, "", "matches of such a pair"},
      {"most_residual_px", &o.most_residual_px, {0.1, 100}, "px", "greatest residual of a rectified pair"},
      {"least_matches", &o.least_matches, {8, 1000}, "", "least matches that agree"},
      {"rounds", &o.rounds, {1, 10}, "", "rounds of corner tracking"},
      {"restart_share", &o.restart_share, {0, 1}, "", "corners on common rows below which it restarts"},
      {"least_parallax_px",
       &o.least_parallax_px,
       {0, 100},
       "px",
       "parallax below which a camera hardly moved"}};
  append_parameters(all, "features", parameters_of(o.features));
  append_parameters(all, "tracking", parameters_of(o.tracking));
  append_parameters(all, "rotations", parameters_of(o.rotations));
  append_parameters(all, "offsets", parameters_of(o.offsets));
  return all;
}

}  // namespace palpable::vision
