// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"

#include <array>
#include <numbers>
#include <optional>

// Parameters of contour extraction. Defaults were chosen on drawn shapes and on pictures with added grain and
// speckle (docs/contours.md); the same ones are used for every picture.
namespace palpable::vision {

enum class ContourMethod {
  /// Gaussian derivatives over four scales, all channels, averaged as a structure tensor (docs/contours.md).
  standard,
  /// Pairs of boxes in many directions and sizes (docs/contours.md): takes seconds, robust to speckle.
  best,
  /// The paper's own (GHD 2006, section 3.2): Sobel, Otsu's threshold, Climent's masks in their octants.
  paper
};

/// The channels that edges are measured in.
struct ChannelOptions {
  /// Weight of CIELAB's a and b relative to L. 0 … 10.
  float chroma_weight = 2.0F;
  /// Pictures of more than 8 bits are stretched: this quantile becomes black. 0 … 1, below high_quantile.
  double low_quantile = 0.001;
  /// This quantile becomes white. 0 … 1.
  double high_quantile = 0.999;
};

/// Of ContourMethod::standard. Its scales are 1, 2, 4 and 8 px: the last two are scale 2 on the picture
/// halved once and twice.
struct StandardContourOptions {
  /// Weight of second derivatives relative to first ones. Above 0.58 a thin line has one ridge; up to 1 a
  /// step has one (by a second-order expansion of the energy about their centres). 0 … 2.
  float second_derivative_weight = 1.0F;
  /// Weights of the four scales, finest first: the finest keeps corners in place. Each > 0.
  std::array<float, 4> scale_weights{0.4F, 0.2F, 0.2F, 0.2F};
  /// A scale's weight is multiplied by 1 - grain_factor · median / energy_quantile of its energy: energy
  /// everywhere means grain or texture. 0 … 10 and 0.5 … 1.
  float grain_factor = 2.0F;
  double energy_quantile = 0.95;
  /// Least value of that factor. > 0 … 1.
  float least_scale_share = 0.05F;
  /// Gaussian that averages the structure tensor of scale 2, px. 0.5 … 32.
  double tensor_blur_px = 2.0;
  /// Energy (in the picture's range 0 … 1) that maps to strength one half. > 0 … 1.
  float half_contrast = 0.12F;
  /// Texture suppression: the mean strength in a ring is subtracted, the difference of two Gaussians. Size of
  /// the inner one. 1 … 64 px, below texture_outer_px.
  double texture_inner_px = 2.0;
  /// Size of the outer one. 1 … 64 px.
  double texture_outer_px = 12.0;
  /// In grainy pictures the strength is weighted by the distinctness of the two sides (at 8, 16 and 32 px),
  /// with at most this exponent. 0 … 2.
  float distinctness_exponent = 0.5F;
  /// Window of the local standard deviation for derivatives of scale 2 px. 0.5 … 32 px.
  double spread_window_px = 3.0;
  /// Lower bound of that deviation, which avoids amplifying faint noise. > 0 … 1.
  float least_spread = 0.05F;
};

/// Of ContourMethod::best.
struct BestContourOptions {
  /// Directions of the pair of boxes over half a turn. 4 … 64.
  int directions = 8;
  /// Heights of a box as shares of the picture's diagonal. Each > 0 … 0.25.
  std::array<double, 3> box_heights{0.007, 0.014, 0.028};
  /// A box's width (along the edge) over its height. 0.25 … 16.
  double box_aspect = 2.0;
  /// Lower bound of a box's standard deviation, in the picture's range. > 0 … 1.
  float least_spread = 0.1F;
  /// Difference over spread that maps to strength one half. > 0 … 10.
  float half_difference = 1.0F;
  /// The least threshold in grain: a difference of this many standard deviations at every height. 0 … 10.
  float boundary_difference = 1.5F;
  /// If the trust in the standard method's finest scale is below this, boxes alone decide. 0 … 1, below
  /// clear_trust.
  float grain_trust = 0.58F;
  /// If it is above this, the standard method decides. 0 … 1.
  float clear_trust = 0.70F;
  /// Gaussian over each direction's responses, px, so that a line is one ridge. 0.5 … 8.
  double smooth_px = 1.0;
  /// Added to responses before their logarithms are taken: a lower one at one height cannot remove a
  /// boundary. 1e-6 … 0.1.
  float least_response = 1e-3F;
  /// Where the standard method has more than this share of the decision, its directions are used. 0 … 1.
  float direction_share = 0.5F;
};

/// Restores corners that blurring has rounded off (contour_corners.hpp).
struct CornerOptions {
  /// The straight pieces of a corner begin at this distance from it: nearer, blur rounds them. 1 … 32 px,
  /// below far_px.
  double near_px = 3.5;
  /// They end at this distance: farther, they may be curved. 1 … 32 px.
  double far_px = 10.0;
  /// Least number of pixels of a piece. 3 … 32.
  int least_pixels = 5;
  /// A piece is straight if its RMS distance from a line is at most this. > 0 … 4 px.
  double straight_px = 0.25;
  /// It must reach to within this distance of far_px. 0 … 32 px.
  double end_gap_px = 2.0;
  /// And if its bend is at most this share of the corner's turn (an arc bends by a third). > 0 … 1.
  double bend_share = 1.0 / 6.0;
  /// Least turn of the line that is a corner, radians. 0 … π, below most_turn.
  double least_turn = std::numbers::pi / 6.0;
  /// Greatest turn of the line that is a corner, radians. 0 … π.
  double most_turn = std::numbers::pi * 5.0 / 6.0;
  /// A corner lies at most this far from the line's rounded pixels. > 0 … 16 px.
  double longest_px = 3.0;
  /// There is no corner if tangents 4 px around agree better than this (length of the mean doubled-angle
  /// vector). 0 … 1.
  float straight_agreement = 0.9F;
};

/// From strengths to one-pixel-wide lines.
struct LineOptions {
  /// A line that reaches the threshold is followed down to this share of it. 0 … 1.
  double followed_share = 0.5;
  CornerOptions corners;
};

struct ContourOptions {
  ContourMethod method = ContourMethod::standard;
  /// Strength (0 … 1) from which a pixel is boundary; not set = Otsu's method.
  std::optional<double> threshold;
  /// Lower bound of Otsu's threshold, which always splits the values, even of an empty picture. 0 … 1.
  double least_threshold = 0.02;
  ChannelOptions channels;
  StandardContourOptions standard;
  BestContourOptions best;
  LineOptions lines;
};

/// Every parameter with its range, except the threshold, which may be unset.
std::vector<Parameter> parameters_of(ContourOptions& options);

/// Errors: usage, for a parameter out of its range, and for pairs that are not ascending.
Result<void> check(const ContourOptions& options);

}  // namespace palpable::vision
