// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo_method.hpp"

namespace palpable::vision {

/// The method `best`, the default for files. AD-Census costs (Mei et al. 2011) averaged over small crosses
/// and semi-global matching give both views a start; a semi-global search over slanted planes
/// (plane_search.hpp) then turns steps into surfaces, and in its later rounds each view tells the other what
/// is hidden from it, so that hidden surfaces go on as the planes of what lies behind. Gives a confidence; no
/// pixel is left unknown. docs/stereo-best.md has figures for each part.
Result<MatchOutput> match_best(const MatchInput& input, const StereoOptions& options, const Work& work);

}  // namespace palpable::vision
