// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/figure.hpp"
#include "palpable/draw/heading.hpp"
#include "palpable/models/field/field.hpp"

#include <memory>

namespace palpable::draw {

/// A cut through a solid from left to right at height `y_m`, seen from below: distance in colours with lines
/// of equal distance, the cells, and the force of a spring of 1 N/mm inside.
Figure field_section_figure(std::shared_ptr<const models::Field> field, double y_m, const Heading& heading);
/// The same of a dense field, which has no cells to draw.
Figure field_section_figure(std::shared_ptr<const models::FieldOnLattice> field, double y_m,
                            const Heading& heading);

}  // namespace palpable::draw
