// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/sculpt/triangles/hole_closing.hpp"
#include "palpable/sculpt/triangles/joined_sheets.hpp"
#include "palpable/sculpt/triangles/open_sheets.hpp"

#include <cstdint>
#include <span>

namespace palpable::sculpt {

/// Bodies with holes whose rims lie on each other but are divided differently may be one body: closed one by
/// one, each gets a lid of its own, and the space between the lids is air. Where the lids of the surface that
/// they form together are smaller than theirs, its divided triangles replace theirs in `whole`, after the
/// others. `holes` are those of `whole`, whose parts face outwards. Returns whether anything was joined; the
/// orientations and holes are then to be determined anew.
bool join_bodies(Mesh& whole, std::span<const Hole> holes, const TouchingDistances& distances,
                 const OpenSheetOptions& options, std::uint64_t seed);

}  // namespace palpable::sculpt
