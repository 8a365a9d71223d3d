// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/describe/peaks.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cstddef>
#include <vector>

namespace palpable::describe {

/// A hole through a solid, or a hollow with a higher rim.
struct Opening {
  Place place;
  /// Its bounding box.
  double width_m = 0.0;
  double height_m = 0.0;
  /// Depth below the lowest point of its rim; for a hole, the height of the solid.
  double depth_m = 0.0;
  bool through = false;
};

/// The shape that the outline of a solid resembles, without its holes.
enum class OutlineKind { rectangular, round, oval, other };

/// The shape of a solid seen from above.
struct SolidShape {
  OutlineKind outline = OutlineKind::other;
  /// Symmetry, 0 … 1: intersection over union of the outline, without holes, and its mirror image. Mirrored
  /// left to right, and top to bottom, about the centre of its box.
  double left_right = 0.0;
  double top_bottom = 0.0;
  /// Number of separate bodies.
  std::size_t pieces = 0;
  /// The largest area first.
  std::vector<Opening> openings;
  /// Local maxima, the most prominent first (find_peaks()).
  std::vector<Peak> parts;
  /// The highest place: of the highest part, or of the samples if there is none.
  Place highest;
  double highest_m = 0.0;
  /// Whether the solid's heights differ by less than the least prominence of a part.
  bool is_flat = false;
};

/// Fractions of the solid's height or of the area of its box.
struct SolidShapeOptions {
  /// Minimum prominence of a part and depth of a hollow, 0 … 1; the default is 3 mm of 100 mm.
  double least_prominence = 0.03;
  /// Minimum area of a part, a piece and an opening, 0 … 1; the default is a pin of 0.5 mm on 100 x 100 mm.
  double least_area = 2.5e-5;
  /// Minimum intersection over union of an outline and the shape it is named by, 0.5 … 1.
  double alike = 0.95;
};
std::vector<Parameter> parameters_of(SolidShapeOptions& options);

/// Whether a place seen from above belongs to a solid, by its height above the solid's base; `size_m` is the
/// solid's greatest height. Elsewhere the view from above has the height of the base.
inline bool is_of_solid(double height_m, double size_m) {
  constexpr double kShare = 0.005;
  return height_m > kShare * size_m;
}

/// `from_above`: the solid's heights; `base_m` or less outside the solid. The options must be in their
/// ranges.
SolidShape solid_shape(const models::Relief& from_above, double base_m,
                       const SolidShapeOptions& options = {});

}  // namespace palpable::describe
