// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/models/relief/relief.hpp"

#include <string>
#include <vector>

namespace palpable::describe {

/// Describes a solid seen from above, in two parts. First: `heading` (the name with a full stop), size,
/// outline, parts, openings and highest point. Second: the offset from `probe` to the highest point, and each
/// part and opening. `base_m` and `size_m`: base height and size of the solid's box.
std::vector<std::string> solid_parts(const models::Relief& from_above, double base_m, Vec3 size_m,
                                     const std::string& heading, Place probe);

}  // namespace palpable::describe
