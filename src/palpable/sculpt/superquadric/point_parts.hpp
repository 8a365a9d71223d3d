// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Parts of a cloud of points (metres, finite), as the numbers of their points, in rising order.
namespace palpable::sculpt {

using Members = std::vector<std::uint32_t>;

/// One point of each cell of a grid so coarse that at most `most` are left; all, where there are no more.
Members thinned(std::span<const Vec3> points, std::size_t most);

/// The connected components of the members: within one, each point has another within `gap_m`.
std::vector<Members> pieces_of(std::span<const Vec3> points, const Members& members, double gap_m);

/// The members in two halves of the same number, across the longest way between two of them. Not empty.
std::array<Members, 2> halved(std::span<const Vec3> points, const Members& members);

}  // namespace palpable::sculpt
