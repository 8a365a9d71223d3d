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
  /// Weight of CIELAB's a and b beside L. 0 … 10.
  float chroma_weight = 2.0F;
  /// Pictures of more than 8 bits are stretched between these quantiles. 0 <= low < high <= 1.
  double low_quantile = 0.001;
  double high_quantile = 0.999;
};

/// Of ContourMethod::standard. Its scales are 1, 2, 4 and 8 px: the last two are scale 2 on the picture
/// halved once and twice.
struct StandardContourOptions {
  /// Weight of second derivatives beside first ones: above 0.58 a thin line has one ridge, up to 1 a step has
  /// one (second-order expansion of the energy about the centre of each). 0 … 2.
  float second_derivative_weight = 1.0F;
  /// Weights of the four scales, finest first: the finest keeps corners in place. Each > 0.
  std::array<float, 4> scale_weights{0.4F, 0.2F, 0.2F, 0.2F};
  /// A scale's weight is multiplied by 1 - factor · median / 95th percentile of its energy, and by no less
  /// than the floor: energy everywhere is grain or texture. Factor 0 … 10, floor > 0 … 1.
  float grain_factor = 2.0F;
  float least_scale_share = 0.05F;
  /// Gaussian that averages the structure tensor of scale 2, px. 0.5 … 32.
  double tensor_blur_px = 2.0;
  /// Energy (in the picture's range 0 … 1) that maps to strength one half. > 0 … 1.
  float half_contrast = 0.12F;
  /// Texture suppression: the mean strength between Gaussians of these sizes is subtracted. 1 … 64 px, inner
  /// < outer.
  double texture_inner_px = 2.0;
  double texture_outer_px = 12.0;
  /// Distinctness of the two sides (at 8, 16 and 32 px) counts in grainy pictures, with at most this
  /// exponent. 0 … 2.
  float distinctness_exponent = 0.5F;
  /// Window of the local spread beside derivatives of scale 2 px; and the spread that every place has at
  /// least, against amplifying faint noise. 0.5 … 32 px; > 0 … 1.
  double spread_window_px = 3.0;
  float least_spread = 0.05F;
};

/// Of ContourMethod::best.
struct BestContourOptions {
  /// Directions of the pair of boxes over half a turn. 4 … 64.
  int directions = 8;
  /// Heights of a box as shares of the picture's diagonal, each > 0 … 0.25; and its width (along the edge)
  /// over its height, 0.25 … 16.
  std::array<double, 3> box_heights{0.007, 0.014, 0.028};
  double box_aspect = 2.0;
  /// Spread that every box has at least, in the picture's range. > 0 … 1.
  float least_spread = 0.1F;
  /// Difference over spread that maps to strength one half. > 0 … 10.
  float half_difference = 1.0F;
  /// The least threshold in grain: a difference of so many spreads at every height. 0 … 10.
  float boundary_difference = 1.5F;
  /// Where the finest scale of the standard method is trusted less than the first (0 … 1), boxes alone
  /// decide; from the second on, the standard method does. First < second.
  float grain_trust = 0.58F;
  float clear_trust = 0.70F;
  /// Gaussian over each direction's responses, px, so that a line is one ridge. 0.5 … 8.
  double smooth_px = 1.0;
};

/// Restores corners that blurring has rounded off (contour_corners.hpp).
struct CornerOptions {
  /// The straight pieces beside a corner lie between these distances from it, px: nearer the blur rounds
  /// them, farther they need not be straight. 1 … 32, near < far.
  double near_px = 3.5;
  double far_px = 10.0;
  /// A piece needs so many pixels. 3 … 32.
  int least_pixels = 5;
  /// A piece is straight where its pixels lie this close to a line (root mean square, px), and where it bends
  /// by no more than this share of the corner's turn (an arc bends by a third). > 0 … 4; > 0 … 1.
  double straight_px = 0.25;
  double bend_share = 1.0 / 6.0;
  /// Turns of the line that are corners, radians. 0 … π, least < most.
  double least_turn = std::numbers::pi / 6.0;
  double most_turn = std::numbers::pi * 5.0 / 6.0;
  /// A corner lies at most this far from the line's rounded pixels. > 0 … 16 px.
  double longest_px = 3.0;
  /// No corner where tangents 4 px around agree better than this (length of the mean doubled angle). 0 … 1.
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
  /// Strength (0 … 1) from which a pixel is boundary; nothing = by Otsu's method.
  std::optional<double> threshold;
  /// What Otsu's threshold does not fall below: less than one grey level of 8 bits. It always splits, even
  /// nothing. 0 … 1.
  double least_threshold = 0.02;
  ChannelOptions channels;
  StandardContourOptions standard;
  BestContourOptions best;
  LineOptions lines;
};

/// Every number of the options with its range, except the threshold, which may be none.
std::vector<Parameter> parameters_of(ContourOptions& options);

/// Errors: usage, for a number out of its range, and for pairs of numbers that do not rise.
Result<void> check(const ContourOptions& options);

}  // namespace palpable::vision
