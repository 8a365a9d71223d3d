// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/field/leaf_fit.hpp"

#include <array>
#include <cstddef>

namespace palpable::sculpt {

inline constexpr std::size_t kQuadraticTerms = 10;
/// c + l.u + u.Qu as c, l and Q (xx, yy, zz, xy, xz, yz), u from the cell's centre in halves of its side.
using Quadratic = std::array<double, kQuadraticTerms>;

/// Least-squares fit to the values and gradients at the selected points, in halves of the cell's side. Where
/// these do not determine how it bends, it is straight.
Quadratic quadratic_through(const CellSamples& samples, const std::array<bool, kFitPlaces>& wanted);
/// The same at all points: a linear map that is the same for every cell.
Quadratic quadratic_through(const CellSamples& samples);

}  // namespace palpable::sculpt
