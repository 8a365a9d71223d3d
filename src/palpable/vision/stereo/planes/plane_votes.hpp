// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/planes/planes.hpp"

// Votes of the planes around a pixel, continued to it: those near and similar in colour weigh most (after
// Bleyer, Rhemann & Rother 2011, section 3.4). `other_disparity` is the other view's, in its own frame: the
// match of its pixel x lies at x + d here; infinite where it shows nothing.
namespace palpable::vision {

/// Which pixels vote, and their weights.
struct PlaneVoteWindow {
  /// The window's reach to each side; px, 1 … 60.
  int reach_px = 20;
  /// Every n-th row and column of it is used; px, 1 … 16.
  int step_px = 2;
  /// A weight falls by e with so much distance (city block); px, 1 … 200.
  float distance_px = 12.0F;
  /// The colour scale of the weights (see the functions); levels of 255, 1 … 255.
  float colour_levels = 20.0F;
  /// Votes of less weight than this together decide nothing; 0 … 1000.
  float least_weight = 1.0F;
};
std::vector<Parameter> parameters_of(PlaneVoteWindow& window);

/// How the background is continued where the other camera does not see it.
struct BackgroundOptions {
  PlaneVoteWindow window = {};
  /// A surface hides what lies behind it by more than this; px, 0 … 10.
  float behind_px = 1.0F;
  /// The weight of pixels filled earlier; 0 … 1.
  float filled_weight = 0.5F;
  /// The share of the votes' weights, sorted by disparity, below the winner: hidden pixels belong to the
  /// background, so the further third wins; out of view the median does. 0 … 1.
  float hidden_quantile = 0.35F;
  float out_of_view_quantile = 0.5F;
  /// Where the slopes of voting planes are fitted.
  FitWindow slopes = {.radius_px = 24, .step_px = 4};
  PlaneFitOptions fit = {};
};
std::vector<Parameter> parameters_of(BackgroundOptions& options);

/// Continues the background where a nearer surface hides it from the other camera, or where it lies out of
/// its view. No colour of the other picture determines a disparity there, so the search leaves slopes between
/// the nearer surface and the background. The planes with which the pixel would be hidden or out of view
/// vote, those of pixels that both views agree about first, round by round inwards. Colour weights: 1 / (1 +
/// (difference / colour_levels)²).
void continue_background(const ColourPlanes& colour, const Raster<float>& other_disparity,
                         const BackgroundOptions& options, PlaneMap& map, const Work& work);

/// The window by which contradicted disparities are replaced.
inline constexpr PlaneVoteWindow kContradictedWindow{
    .reach_px = 15, .step_px = 2, .distance_px = 12.0F, .colour_levels = 10.0F, .least_weight = 0.5F};

/// The map's disparities, but where the two views contradict each other, without one hiding the pixel from
/// the other, the median of the votes of the pixels around that both agree about. Colour weights:
/// exp(-difference / colour_levels).
Raster<float> replace_contradicted(const ColourPlanes& colour, const Raster<float>& other_disparity,
                                   const PlaneVoteWindow& window, const PlaneMap& map, const Work& work);

}  // namespace palpable::vision
