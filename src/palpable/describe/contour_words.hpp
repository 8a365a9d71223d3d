// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/models/contours/boundary_map.hpp"

#include <string>
#include <vector>

namespace palpable::describe {

/// Describes contours in two parts. First: `heading` (the name with a full stop), the number of lines, their
/// junctions and the longest line. Second: the offset from `probe` to the nearest line, and each line.
std::vector<std::string> contour_parts(const models::BoundaryMap& map, const std::string& heading,
                                       Place probe);

}  // namespace palpable::describe
