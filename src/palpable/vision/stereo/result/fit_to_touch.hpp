// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/methods/stereo_options.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <cstdint>
#include <string>

namespace palpable::vision {

/// Why the depth of a pixel cannot be trusted.
enum class Trouble : std::uint8_t {
  none,
  /// Its place lies beyond the other picture's edge.
  out_of_view,
  /// No texture distinguishes the place from its neighbours.
  plain,
  /// The left-right check fails: hidden from the other camera, moved, a reflection …
  contradicted
};

/// Whether a pair is fit to be touched.
struct FitToTouch {
  /// Share of the textured pixels seen by both whose depth the other picture confirms, 0 … 1.
  double agreement = 0.0;
  /// Share of all pixels whose depth is confirmed.
  double coverage = 0.0;
  double textured = 0.0;
  /// Share of the left picture that lies inside the right one.
  double overlap = 0.0;
  /// From the farthest to the nearest twentieth of the confirmed pixels, in pixels of disparity.
  double depth_range_px = 0.0;
  /// The middle of the left picture's levels, 0 … 1.
  double brightness = 0.0;
  /// A Trouble per pixel of the left picture.
  Raster<std::uint8_t> trouble;
};

/// A match whose confidence is 1 where the right picture, matched by itself, leads back within a pixel, else
/// 0. `fast` gives that by itself; the other methods run twice. Errors: as match().
Result<StereoMatch> match_confirmed(const StereoPair& pair, StereoMethod method, const StereoOptions& options,
                                    const Work& work);

/// Judges a match_confirmed() of `pair`.
FitToTouch fit_to_touch(const StereoPair& pair, const StereoMatch& match, const Work& work);

/// For a teacher, one sentence: whether it is fit, with the figure; where it will feel wrong and why; what to
/// do about it.
std::string sentence_of(const FitToTouch& fit);

}  // namespace palpable::vision
