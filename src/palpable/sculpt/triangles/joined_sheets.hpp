// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/sculpt/triangles/open_sheets.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// Within which distance places are the same, and rims are on bodies; metres.
struct TouchingDistances {
  double same_m = 0.0;
  double touching_m = 0.0;
};

/// Sheets whose rims lie on each other but are divided differently, as the walls of many houses, may form a
/// body together. Then its divided triangles replace theirs in `given`, whose vertices are those of `whole`,
/// and in `found`, which is not empty and keeps its count. `whole` has the same triangles, oriented; its
/// bodies may hide rims, as in open_sheets_of().
void join_sheets(const Mesh& whole, std::vector<std::array<std::uint32_t, 3>>& given, OpenSheets& found,
                 const TouchingDistances& distances, const OpenSheetOptions& options, std::uint64_t seed);

}  // namespace palpable::sculpt
