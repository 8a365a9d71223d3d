// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/models/contours/boundary_map.hpp"

#include <string>
#include <vector>

namespace palpable::describe {

/// The description of contours in parts: how many lines there are, how they meet and the longest one; then
/// the way from `probe` to the nearest line, and each line. `heading` begins the first part: the name, with a
/// full stop.
std::vector<std::string> contour_parts(const models::BoundaryMap& map, const std::string& heading,
                                       Place probe);

}  // namespace palpable::describe
