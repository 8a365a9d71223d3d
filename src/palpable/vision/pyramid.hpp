// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo_method.hpp"

namespace palpable::vision {

/// Where disparity steps: as correlation finds it, or moved to the picture's edges (Cochran & Medioni 1992).
enum class PyramidEdges { area, features };

struct PyramidOptions {
  /// Weight of a smooth surface against that of the picture, which lies between 0 and 1; >= 0.
  float surface_weight = 0.05F;
  int iterations = 20;
  PyramidEdges edges = PyramidEdges::area;
};

/// Beeler's method as Gomez describes it, from coarse to fine by normalised correlation.
Result<MatchOutput> match_pyramid(const MatchInput& input, const PyramidOptions& options, const Work& work);
/// The same with the options' defaults.
Result<MatchOutput> match_pyramid(const MatchInput& input, const StereoOptions& options, const Work& work);

}  // namespace palpable::vision
