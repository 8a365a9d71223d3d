// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"
#include "palpable/models/field/field.hpp"

#include <memory>
#include <vector>

namespace palpable::draw {

/// The camera that looks at a solid.
struct SolidViewOptions {
  /// Direction of the camera from the solid, degrees: azimuth to the right from the front (+z), -180 ... 180;
  /// elevation, -89 ... 89.
  double azimuth_deg = 30.0;
  double elevation_deg = 25.0;
  /// Half of the solid's angular size, degrees, 2 ... 40: larger is nearer, with more perspective.
  double half_angle_deg = 12.0;
};
std::vector<Parameter> parameters_of(SolidViewOptions& options);

/// A solid rendered in perspective from its field: lit from the upper left, darker in hollows and at the rim,
/// paler with the distance. The bounding box's edges are labelled in millimetres. Options must be in range.
Figure solid_figure(std::shared_ptr<const models::Field> field, const SolidViewOptions& options,
                    const FigureTitle& title);
Figure solid_figure(std::shared_ptr<const models::FieldOnLattice> field, const SolidViewOptions& options,
                    const FigureTitle& title);

}  // namespace palpable::draw
