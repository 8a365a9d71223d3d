// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/describe/peaks.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cstddef>
#include <vector>

namespace palpable::describe {

/// A hole through a solid, or a hollow in it that is higher all around.
struct Opening {
  Place place;
  /// The box around it.
  double width_m = 0.0;
  double height_m = 0.0;
  /// Below the lowest place of its rim; of a hole, the solid's height there.
  double depth_m = 0.0;
  bool through = false;
};

/// What the outline of a solid resembles, holes aside.
enum class OutlineKind { rectangular, round, oval, other };

/// A solid as it is seen from above.
struct SolidShape {
  OutlineKind outline = OutlineKind::other;
  /// How much of the outline, holes aside, is common to it and its mirror image, 0 … 1: area of the
  /// intersection over that of the union; mirrored left to right, and top to bottom, about the middle of its
  /// box.
  double left_right = 0.0;
  double top_bottom = 0.0;
  /// Bodies that are apart from each other.
  std::size_t pieces = 0;
  /// The largest first.
  std::vector<Opening> openings;
  /// Local maxima, the most prominent first (find_peaks()).
  std::vector<Peak> parts;
};

/// Shares of the solid's height or of the area of its box.
struct SolidShapeOptions {
  /// Least prominence of a part and least depth of a hollow, 0 … 1: 3 mm of 100 mm.
  double least_prominence = 0.03;
  /// Least area of a part, a piece and an opening, 0 … 1.
  double least_area = 5e-4;
  /// An outline resembles a shape that it has this much in common with, 0.5 … 1.
  double alike = 0.95;
};
std::vector<Parameter> parameters_of(SolidShapeOptions& options);

/// `from_above`: the solid's heights; `base_m` or less where it does not stand. The options must be in their
/// ranges.
SolidShape solid_shape(const models::Relief& from_above, double base_m,
                       const SolidShapeOptions& options = {});

}  // namespace palpable::describe
