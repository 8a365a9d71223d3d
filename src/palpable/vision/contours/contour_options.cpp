// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contour_options.hpp"

#include <tuple>

namespace palpable::vision {
namespace {

/// The lower end of a range that excludes 0.
constexpr double kLeast = 1e-6;

std::vector<Parameter> parameters_of(ChannelOptions& o) {
  return {{"chroma_weight", &o.chroma_weight, {0, 10}, "", "weight of colour relative to lightness"},
          {"low_quantile", &o.low_quantile, {0, 1}, "", "black point of pictures of more than 8 bits"},
          {"high_quantile", &o.high_quantile, {0, 1}, "", "white point of pictures of more than 8 bits"}};
}

std::vector<Parameter> parameters_of(StandardContourOptions& o) {
  return {
      {"second_derivative_weight", &o.second_derivative_weight, {0, 2}, "", "weight of second derivatives"},
      {"scale_weight_1px", o.scale_weights.data(), {kLeast, 1e3}, "", "weight of scale 1 px"},
      {"scale_weight_2px", &o.scale_weights[1], {kLeast, 1e3}, "", "weight of scale 2 px"},
      {"scale_weight_4px", &o.scale_weights[2], {kLeast, 1e3}, "", "weight of scale 4 px"},
      {"scale_weight_8px", &o.scale_weights[3], {kLeast, 1e3}, "", "weight of scale 8 px"},
      {"grain_factor", &o.grain_factor, {0, 10}, "", "factor by which grain lowers a scale's weight"},
      {"energy_quantile", &o.energy_quantile, {0.5, 1}, "", "high energy that the median is compared with"},
      {"least_scale_share", &o.least_scale_share, {kLeast, 1}, "", "least share of a scale's weight"},
      {"tensor_blur_px", &o.tensor_blur_px, {0.5, 32}, "px", "blur of the structure tensor"},
      {"half_contrast", &o.half_contrast, {kLeast, 1}, "", "energy that maps to strength one half"},
      {"texture_inner_px", &o.texture_inner_px, {1, 64}, "px", "inner size of the texture ring"},
      {"texture_outer_px", &o.texture_outer_px, {1, 64}, "px", "outer size of the texture ring"},
      {"distinctness_exponent",
       &o.distinctness_exponent,
       {0, 2},
       "",
       "how much distinct sides count in grain"},
      {"spread_window_px", &o.spread_window_px, {0.5, 32}, "px", "window of the local spread"},
      {"least_spread", &o.least_spread, {kLeast, 1}, "", "least local spread"}};
}

std::vector<Parameter> parameters_of(BestContourOptions& o) {
  return {{"directions", &o.directions, {4, 64}, "", "directions over half a turn"},
          {"box_height_small", o.box_heights.data(), {kLeast, 0.25}, "of the diagonal", "smallest box"},
          {"box_height_middle", &o.box_heights[1], {kLeast, 0.25}, "of the diagonal", "middle box"},
          {"box_height_large", &o.box_heights[2], {kLeast, 0.25}, "of the diagonal", "largest box"},
          {"box_aspect", &o.box_aspect, {0.25, 16}, "", "width of a box over its height"},
          {"least_spread", &o.least_spread, {kLeast, 1}, "", "least spread of a box"},
          {"half_difference", &o.half_difference, {kLeast, 10}, "spreads", "difference of strength one half"},
          {"boundary_difference", &o.boundary_difference, {0, 10}, "spreads", "least boundary in grain"},
          {"grain_trust", &o.grain_trust, {0, 1}, "", "below it boxes alone decide"},
          {"clear_trust", &o.clear_trust, {0, 1}, "", "above it the standard method decides"},
          {"smooth_px", &o.smooth_px, {0.5, 8}, "px", "blur of each direction's response"},
          {"least_response", &o.least_response, {kLeast, 0.1}, "", "response that no height falls below"},
          {"direction_share", &o.direction_share, {0, 1}, "", "above it directions are the standard ones"}};
}

std::vector<Parameter> parameters_of(CornerOptions& o) {
  return {{"near_px", &o.near_px, {1, 32}, "px", "nearest pixel of a piece beside a corner"},
          {"far_px", &o.far_px, {1, 32}, "px", "farthest pixel of a piece beside a corner"},
          {"least_pixels", &o.least_pixels, {3, 32}, "px", "least pixels of a piece"},
          {"straight_px", &o.straight_px, {kLeast, 4}, "px", "greatest RMS distance from a straight line"},
          {"end_gap_px", &o.end_gap_px, {0, 32}, "px", "how much shorter than far_px a piece may be"},
          {"bend_share", &o.bend_share, {kLeast, 1}, "", "greatest bend over the corner's turn"},
          {"least_turn", &o.least_turn, {0, std::numbers::pi}, "rad", "least turn of a corner"},
          {"most_turn", &o.most_turn, {0, std::numbers::pi}, "rad", "greatest turn of a corner"},
          {"longest_px", &o.longest_px, {kLeast, 16}, "px", "farthest corner from its rounded line"},
          {"straight_agreement", &o.straight_agreement, {0, 1}, "", "agreement of tangents along a line"}};
}

Result<void> check_rising(double low, double high, const char* what) {
  if (low < high) return {};
  return Error{ErrorCode::usage, "the first must be below the second", what};
}

}  // namespace

std::vector<Parameter> parameters_of(ContourOptions& options) {
  std::vector<Parameter> all{
      {"least_threshold", &options.least_threshold, {0, 1}, "", "lower bound of Otsu's threshold"},
      {"lines.followed_share",
       &options.lines.followed_share,
       {0, 1},
       "",
       "share of the threshold down to which lines are followed"}};
  append_parameters(all, "channels", parameters_of(options.channels));
  append_parameters(all, "standard", parameters_of(options.standard));
  append_parameters(all, "best", parameters_of(options.best));
  append_parameters(all, "lines.corners", parameters_of(options.lines.corners));
  return all;
}

Result<void> check(const ContourOptions& options) {
  if (options.threshold && !(*options.threshold >= 0.0 && *options.threshold <= 1.0))
    return Error{ErrorCode::usage, "the threshold must be 0 to 1", {}};
  if (auto in_range = check_ranges(options); !in_range) return in_range;
  const CornerOptions& corners = options.lines.corners;
  for (const auto& [low, high, what] :
       {std::tuple{options.channels.low_quantile, options.channels.high_quantile,
                   "channels.low_quantile, channels.high_quantile"},
        std::tuple{options.standard.texture_inner_px, options.standard.texture_outer_px,
                   "standard.texture_inner_px, standard.texture_outer_px"},
        std::tuple{double{options.best.grain_trust}, double{options.best.clear_trust},
                   "best.grain_trust, best.clear_trust"},
        std::tuple{corners.near_px, corners.far_px, "lines.corners.near_px, lines.corners.far_px"},
        std::tuple{corners.least_turn, corners.most_turn,
                   "lines.corners.least_turn, lines.corners.most_turn"}})
    if (auto rising = check_rising(low, high, what); !rising) return rising;
  return {};
}

}  // namespace palpable::vision
