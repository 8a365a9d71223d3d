// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/measure/relief_score.hpp"
#include "palpable/session/make/make_scene.hpp"

#include <vector>

namespace palpable::session {

/// One detail operator's relief of an input, and its score.
struct ComparedDetail {
  sculpt::DetailOperator detail;
  models::Relief relief;
  measure::ReliefScore score;
  double seconds = 0.0;
};

/// Makes reliefs of the same depth with every detail operator; everything else as in `options`; a pair is
/// matched once. Each relief is scored against the depth after clipping and hole filling
/// (measure/relief_score.hpp). Long work. Errors: as make_scene(); usage for an input that does not give a
/// relief.
Result<std::vector<ComparedDetail>> compare_details(const MakeOptions& options, const Work& work);

}  // namespace palpable::session
