// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Parts of a point cloud (metres, finite) as ascending indices of their points.
namespace palpable::sculpt {

using Members = std::vector<std::uint32_t>;

/// One point of each cell of a grid, the finest that leaves at most `most` points; all points if there are
/// no more.
Members thinned(std::span<const Vec3> points, std::size_t most);

/// The connected components of the members: within one, each point has another within `gap_m`.
std::vector<Members> pieces_of(std::span<const Vec3> points, const Members& members, double gap_m);

/// Two sides of the plane, of 13 directions, that meets the fewest points over those of the smaller side
/// (Cheeger 1970), within a layer of `width_m`. Neither is empty, unless all points are in one place.
std::array<Members, 2> cut_at_neck(std::span<const Vec3> points, const Members& members, double width_m);

}  // namespace palpable::sculpt
