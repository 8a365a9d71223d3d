// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/measure/relief_score.hpp"
#include "palpable/session/make/make_scene.hpp"

#include <vector>

namespace palpable::session {

/// One operator's relief of an input, and what a hand would miss on it.
struct ComparedDetail {
  sculpt::DetailOperator detail;
  models::Relief relief;
  measure::ReliefScore score;
  double seconds = 0.0;
};

/// The same depth through every detail operator, all else as `options` say; a pair is matched once. Scored
/// against the depth as it was windowed and closed (measure/relief_score.hpp). Long work. Errors: as
/// make_scene(); usage for an input that becomes no relief.
Result<std::vector<ComparedDetail>> compare_details(const MakeOptions& options, const Work& work);

}  // namespace palpable::session
