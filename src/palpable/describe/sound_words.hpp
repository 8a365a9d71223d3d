// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace palpable::describe {

/// Where a sound comes from, to an eighth of a turn: "ahead", "ahead, to the left", "behind"; more than 30
/// degrees from the horizontal with "and above" or "and below", more than 75 with nothing else. The azimuth
/// is positive to the right.
std::string sound_words(double azimuth_deg, std::optional<double> elevation_deg);

}  // namespace palpable::describe
