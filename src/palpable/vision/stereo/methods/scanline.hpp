// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/cost/cross_window.hpp"
#include "palpable/vision/stereo/methods/column_smoothing.hpp"
#include "palpable/vision/stereo/methods/scanline_path.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

#include <vector>

namespace palpable::vision {

/// How the path of every scanline is found.
struct ScanlineMapOptions {
  CostOptions cost = {};
  CrossOptions window = {};
  PathOptions path = {};
};
std::vector<Parameter> parameters_of(ScanlineMapOptions& options);

/// The paths of all scanlines, before anything is filled or smoothed.
struct ScanlineMap {
  Raster<float> disparity_px;
  /// 1 if both cameras see the pixel and the right picture's path agrees.
  Raster<std::uint8_t> trusted;
};

/// The paths alone, which also initialise other methods. Incomplete if the work was cancelled. The options
/// are valid (check_window_size() for the window).
ScanlineMap scanline_map(const MatchInput& input, const ScanlineMapOptions& options, const Work& work);

/// The parts of the method `scanline`.
struct ScanlineOptions {
  ScanlineMapOptions map = {};
  ColumnOptions columns = {};
};
std::vector<Parameter> parameters_of(ScanlineOptions& options);
/// Errors: usage, for a parameter out of its range or a window that is too large.
Result<void> check(const ScanlineOptions& options);

/// The method `scanline` (Shi & Pai 1997): each scanline's least-cost path, with occluded pixels filled from
/// the background and streaks removed. No pixel is left unknown. Errors: usage (check()), interrupted. The
/// result does not depend on the number of threads.
Result<MatchOutput> match_scanline(const MatchInput& input, const ScanlineOptions& options, const Work& work);

}  // namespace palpable::vision
