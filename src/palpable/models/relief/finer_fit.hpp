// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/models/relief/finer_cells.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/models/relief/touch_points.hpp"

#include <vector>

namespace palpable::models {

/// How closely finer cells follow the surface of a ball.
struct FinerFit {
  /// A finer level is added where the error at a tested position is larger.
  double tolerance_m = 4e-6;
  /// Most control values of all finer cells, of 4 bytes each. Where more would be needed, the places with the
  /// largest errors get them.
  double most_values = 1e7;
};

/// The cells in which `relief`, an approximation of the surface on which the centre of a ball moves, differs
/// from the heights that its contacts give, by more than the tolerance; fitted level by level, each with half
/// the distance of the control values, until the tolerance is reached. In these cells the surface remains
/// twice continuously differentiable. Not within two pixels of the border. Long work: reports progress, polls
/// cancel.
std::vector<FinerCell> fit_finer_cells(const Relief& relief, const TouchPoints& contacts, const FinerFit& fit,
                                       const Work& work);

}  // namespace palpable::models
