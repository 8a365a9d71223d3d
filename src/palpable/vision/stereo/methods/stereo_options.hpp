// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/vision/stereo/confidence/confidence.hpp"
#include "palpable/vision/stereo/methods/best.hpp"
#include "palpable/vision/stereo/methods/fast.hpp"
#include "palpable/vision/stereo/methods/graph_cut.hpp"
#include "palpable/vision/stereo/methods/pyramid.hpp"
#include "palpable/vision/stereo/methods/scanline.hpp"
#include "palpable/vision/stereo/methods/segments.hpp"
#include "palpable/vision/stereo/problem/exposure_match.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"
#include "palpable/vision/stereo/problem/stereo_method.hpp"
#include "palpable/vision/stereo/range/disparity_range.hpp"
#include "palpable/vision/stereo/range/pair_check.hpp"

#include <vector>

namespace palpable::vision {

/// The options of match(): the range of disparities, and the options of each method. docs/stereo.md says on
/// which pictures the defaults were chosen.
struct StereoOptions {
  /// Disparities 0 … max_disparity_px are searched; 0 = found automatically (find_disparity_range).
  int max_disparity_px = 0;
  PreparationOptions preparation = {};
  RangeOptions range = {};
  PairCheckOptions pair_check = {};
  ConfidenceOptions confidence = {};
  ScanlineOptions scanline = {};
  GraphCutOptions graph_cut = {};
  SegmentsOptions segments = {};
  PyramidOptions pyramid = {};
  FastOptions fast = {};
  BestOptions best = {};
};

/// The parameters of one method, and the common ones (`preparation.…`, `range.…`, `pair_check.…`,
/// `confidence.…`).
std::vector<Parameter> parameters_of(StereoOptions& options, StereoMethod method);
/// Errors: usage, for a parameter of this method, or a common one, out of its range.
Result<void> check(const StereoOptions& options, StereoMethod method);

}  // namespace palpable::vision
