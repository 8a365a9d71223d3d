// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/sculpt/triangles/placement.hpp"

#include <vector>

namespace palpable::recipes {

/// Notes for the user about the placement of a solid in `box`: assumptions about its unit and its up, its
/// scale, and that it lies flat. Empty if the solid keeps its place or everything was given.
std::vector<Note> placement_notes(const sculpt::Placement& placement, const sculpt::Box& box,
                                  const sculpt::PlacementOptions& options);

/// A note for the user if a mesh in `box` is so far from the origin of its coordinates, as projected map
/// coordinates are, that their rounding to `step` (mesh_surface_check.hpp) changes its shape by more than
/// 0.01
/// %. Else empty.
std::vector<Note> rounding_notes(const sculpt::Box& box, double step);

}  // namespace palpable::recipes
