// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo_method.hpp"

namespace palpable::vision {

/// Beeler's method as Gomez describes it, from coarse to fine by normalised correlation; heeds
/// options.pyramid.
Result<MatchOutput> match_pyramid(const MatchInput& input, const StereoOptions& options, const Work& work);

}  // namespace palpable::vision
