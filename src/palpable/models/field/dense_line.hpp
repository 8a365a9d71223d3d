// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/models/field/dense_field.hpp"

#include <optional>

namespace palpable::models {

/// A part of a straight line on which the distance is too small, in shares of the line, 0 ... 1.
struct Dip {
  /// Where it begins; 0 if the line begins in it.
  double begins = 0.0;
  /// Where the distance is lowest in the first cell of the lattice that has a part of the dip.
  double lowest = 0.0;
};

/// The first dip of the distance below `below_m` on the line between two places in a dense field's box. It is
/// exact, however short: between the faces of the lattice's cells a trilinear distance is a cubic along a
/// line. Nothing if there is none. The work is that of one evaluation for each cell on the line. Tick path.
std::optional<Dip> first_dip(const DenseField& field, Point<SceneFrame> from, Point<SceneFrame> to,
                             double below_m) noexcept;

}  // namespace palpable::models
