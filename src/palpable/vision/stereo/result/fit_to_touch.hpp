// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/methods/stereo_options.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"
#include "palpable/vision/stereo/result/confirming_points.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace palpable::vision {

/// Why the depth of a pixel cannot be trusted.
enum class Trouble : std::uint8_t {
  none,
  /// The match is outside the other picture.
  out_of_view,
  /// No texture distinguishes it from its neighbours.
  plain,
  /// Both views agree, but the pictures hardly determine it: between its surroundings (confidence.hpp).
  guessed,
  /// The left-right check fails: hidden from the other camera, moved, a reflection …
  contradicted
};

/// The deciding reason of a verdict.
enum class FitReason : std::uint8_t {
  all_agree,
  few_points,
  different_places,
  no_parallax,
  contradiction,
  little_depth,
  uncertain_motion,
  other_order
};

/// The same as a clause, for people.
std::string_view words_of(FitReason reason);

/// When the verdict's sentence says what.
struct FitWordsOptions {
  /// A pair that is not fit can be touched with doubt from this confidence on. 0 … 1.
  double doubtful_confidence = 0.1;
  /// A ninth of the picture is named if more than this share of it is not confirmed. 0 … 1.
  double wrong_share = 0.35;
  /// A pair whose disparities differ by less than this feels flat; px, 0 … 100.
  double flat_px = 3.0;
  /// A median level of the left picture below this is dark. 0 … 1.
  double dark_level = 0.2;
  /// Below this one that is not fit is called black. 0 … 1.
  double black_level = 0.04;
  /// If at least this share of the picture has texture, wrong geometry is the only reason that is named.
  /// 0 … 1.
  double textured_share = 0.3;
  /// A share of guessed depth that is said. 0 … 1.
  double guessed_share = 0.2;
};
std::vector<Parameter> parameters_of(FitWordsOptions& options);

/// The thresholds of the verdict. Chosen on seeds 1, 2, 5 and 6 of bench/pair_set.cpp (528 pairs, good and
/// degraded), so that the depths of a pair that is fit have a rank correlation of at least 0.7 with the true
/// ones.
struct FitThresholds {
  /// With fewer distinct points, agreement and the range of disparities decide. 1 … 10000.
  int points = 16;
  /// With fewer than these, the points decide nothing. 1 … 10000.
  int least_points = 5;
  /// Share of them that the dense match confirms. 0 … 1.
  double confirmed = 0.6;
  /// Share of the confirmed points off the dominant plane. 0 … 1.
  double off_plane = 0.025;
  /// Share of the points that a camera which only turned and zoomed does not explain. 0 … 1.
  double beyond_turn = 0.05;
  /// How surely the camera's motion says which point is nearer (ConfirmingPoints). 0 … 1.
  double certainty = 0.75;
  /// Agreement of the dense depth with that of the points (ConfirmingPoints). 0 … 1.
  double depth_order = 0.75;
  /// Share of the common view that both matching directions confirm. 0 … 1.
  double agreement = 0.7;
  /// The same with few points. 0 … 1.
  double agreement_without_points = 0.8;
  /// Least range of disparities with few points; px, 0 … 100.
  double range_without_points_px = 3.0;
  /// Share of the whole picture that is confirmed. 0 … 1.
  double coverage = 0.4;
  /// If more than this share of the pixels is confirmed, fine contrast is texture. 0 … 1.
  double confirmed_texture = 0.6;
  /// If fewer are confirmed, it is noise if contrast_beyond_grain() is less than this. 0 … 10.
  double only_grain = 0.5;
  ConfirmingOptions confirming = {};
  FitWordsOptions words = {};
};

std::vector<Parameter> parameters_of(FitThresholds& thresholds);

/// Quality of a pair's depth for touch.
struct FitToTouch {
  /// Whether the felt shape is right: confidence is at least 0.5.
  bool fit = false;
  /// 1 far above every threshold of FitThresholds, 0.5 at one of them, 0 far below; not a probability. 0 … 1.
  double confidence = 0.0;
  FitReason reason = FitReason::all_agree;
  /// Share of the textured pixels seen by both on whose depth both matching directions agree, 0 … 1.
  double agreement = 0.0;
  /// Share of all pixels whose depth is confirmed, and no guess.
  double coverage = 0.0;
  /// Share of all pixels whose depth is a guess, whatever the reason.
  double guessed = 0.0;
  double textured = 0.0;
  /// Share of the left picture that lies inside the right one.
  double overlap = 0.0;
  /// Disparity between the 5 % and 95 % quantiles of the confirmed pixels.
  double depth_range_px = 0.0;
  /// Median level of the left picture, 0 … 1.
  double brightness = 0.0;
  ConfirmingPoints points;
  /// A Trouble per pixel of the left picture.
  Raster<std::uint8_t> trouble;
};

/// A match with `confirmed`: the left-right check within a pixel. `fast` includes the
/// check; the other methods run twice. Errors: as match().
Result<StereoMatch> match_confirmed(const StereoPair& pair, StereoMethod method, const StereoOptions& options,
                                    const Work& work);

/// Evaluates a result of match_confirmed() for a rectified `pair`. The thresholds are in their ranges.
FitToTouch fit_to_touch(const StereoPair& pair, const StereoMatch& match, const Work& work,
                        const FitThresholds& thresholds = {});

/// One sentence for a layperson: whether the pair is fit, with the figure; where it will feel wrong and why;
/// and what to do about it. The options are in their ranges.
std::string sentence_of(const FitToTouch& fit, const FitWordsOptions& options = {});

}  // namespace palpable::vision
