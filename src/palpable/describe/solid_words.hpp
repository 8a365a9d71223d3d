// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/models/relief/relief.hpp"

#include <string>
#include <vector>

namespace palpable::describe {

/// The description of a solid as it is seen from above, in parts: its size, outline, parts, openings and
/// highest place; then each part and opening, with the way from `probe` to the highest place. `heading`
/// begins the first part: the name, with a full stop. `base_m` and `size_m`: of the solid's box.
std::vector<std::string> solid_parts(const models::Relief& from_above, double base_m, Vec3 size_m,
                                     const std::string& heading, Place probe);

}  // namespace palpable::describe
