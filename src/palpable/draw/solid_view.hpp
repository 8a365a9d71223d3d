// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/draw/figure.hpp"
#include "palpable/draw/heading.hpp"
#include "palpable/models/field/field.hpp"

#include <memory>
#include <vector>

namespace palpable::draw {

/// From where a solid is looked at.
struct SolidViewOptions {
  /// The viewer goes so far to the right around the solid, from its front (+z), degrees, -180 ... 180; and so
  /// far up, -89 ... 89.
  double azimuth_deg = 30.0;
  double elevation_deg = 25.0;
  /// Half of the angle that the solid fills, degrees, 2 ... 40: larger is nearer, with more perspective.
  double half_angle_deg = 12.0;
};
std::vector<Parameter> parameters_of(SolidViewOptions& options);

/// A solid in perspective, as its field has it: lit from the upper left, darker in hollows and at the rim,
/// paler with the distance, in its box with the box's sides in millimetres. Options must be in range.
Figure solid_figure(std::shared_ptr<const models::Field> field, const SolidViewOptions& options,
                    const Heading& heading);
Figure solid_figure(std::shared_ptr<const models::FieldOnLattice> field, const SolidViewOptions& options,
                    const Heading& heading);

}  // namespace palpable::draw
