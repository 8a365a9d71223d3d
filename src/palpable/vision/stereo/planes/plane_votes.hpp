// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/planes/planes.hpp"

// Weighted votes among the planes of nearby pixels, continued to a pixel; near pixels of similar colour have
// the largest weights (after Bleyer, Rhemann & Rother 2011, section 3.4). `other_disparity` is the other
// view's, in its own frame: the match of its pixel x is at x + d here; infinite where it has no content.
namespace palpable::vision {

/// Which pixels vote, and their weights.
struct PlaneVoteWindow {
  /// The window's reach to each side; px, 1 … 60.
  int reach_px = 20;
  /// Every n-th row and column of the window is used; px, 1 … 16.
  int step_px = 2;
  /// Distance (city block) at which a weight falls by e; px, 1 … 200.
  float distance_px = 12.0F;
  /// The colour scale of the weights (see the functions); levels of 255, 1 … 255.
  float colour_levels = 20.0F;
  /// Least sum of weights for a decision; 0 … 1000.
  float least_weight = 1.0F;
};
std::vector<Parameter> parameters_of(PlaneVoteWindow& window);

/// Continuation of the background in occlusions.
struct BackgroundOptions {
  PlaneVoteWindow window = {};
  /// A surface occludes pixels behind it by more than this; px, 0 … 10.
  float behind_px = 1.0F;
  /// Pits deeper than this are kept: gaps whose background is hidden; px, 0 … 100.
  float deepest_pit_px = 4.0F;
  /// The weight of pixels filled earlier; 0 … 1.
  float filled_weight = 0.5F;
  /// The winner's quantile of the votes, sorted by disparity: about a third for occluded pixels, which belong
  /// to the background, and the median outside the other picture. 0 … 1.
  float hidden_quantile = 0.35F;
  float out_of_view_quantile = 0.5F;
  /// Window in which the slopes of voting planes are fitted.
  FitWindow slopes = {.radius_px = 24, .step_px = 4};
  PlaneFitOptions fit = {};
};
std::vector<Parameter> parameters_of(BackgroundOptions& options);

/// Continues the background into occlusions and outside the other picture. No colour determines a disparity
/// there, so the search leaves slopes between the nearer surface and the background. Planes vote with which
/// the pixel would be occluded or outside; voting proceeds in rounds inwards, beginning with pixels that pass
/// the left-right check. Colour weights: 1 / (1 + (difference / colour_levels)²).
void continue_background(const ColourPlanes& colour, const Raster<float>& other_disparity,
                         const BackgroundOptions& options, PlaneMap& map, const Work& work);

/// The window for replacing contradicted disparities.
inline constexpr PlaneVoteWindow kContradictedWindow{
    .reach_px = 15, .step_px = 2, .distance_px = 12.0F, .colour_levels = 10.0F, .least_weight = 0.5F};

/// Fills pits. Where a nearer surface hides a farther one from the other camera, the hidden pixels lie
/// between the two: the disparity steps up by more than `behind_px` from their left to their right. Pixels
/// that are hidden by more than that without such a step, and not deeper than `deepest_pit_px`, are pits of
/// noise in one surface or strips behind a thin object. They get the median of the votes of nearby consistent
/// pixels, if enough of those have their colour. Colour weights: exp(-difference / colour_levels).
void fill_pits(const ColourPlanes& colour, const Raster<float>& other_disparity,
               const BackgroundOptions& options, const PlaneVoteWindow& window, PlaneMap& map,
               const Work& work);

/// The map's disparities, except where the two views contradict each other without an occlusion: there the
/// median of the votes of nearby consistent pixels. Colour weights: exp(-difference / colour_levels).
Raster<float> replace_contradicted(const ColourPlanes& colour, const Raster<float>& other_disparity,
                                   const PlaneVoteWindow& window, const PlaneMap& map, const Work& work);

}  // namespace palpable::vision
