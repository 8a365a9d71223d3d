// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/sculpt/triangles/placement.hpp"

#include <vector>

namespace palpable::recipes {

/// What a person should know about where a solid in `box` was placed: what was assumed of its unit and its
/// up, its scale, and that it lies flat. Nothing where it keeps its place, or where all of it was asked for.
std::vector<Note> placement_notes(const sculpt::Placement& placement, const sculpt::Box& box,
                                  const sculpt::PlacementOptions& options);

}  // namespace palpable::recipes
