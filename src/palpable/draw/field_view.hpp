// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/figure.hpp"
#include "palpable/draw/heading.hpp"
#include "palpable/models/field/field.hpp"

#include <memory>

namespace palpable::draw {

/// A section through a solid in the plane y = `y_m`, seen from below: the signed distance in colours with
/// iso-distance lines, the leaf cells, and the force of a spring of 1 N/mm inside.
Figure field_section_figure(std::shared_ptr<const models::Field> field, double y_m, const Heading& heading);
/// The same for a dense field, without cells.
Figure field_section_figure(std::shared_ptr<const models::FieldOnLattice> field, double y_m,
                            const Heading& heading);

}  // namespace palpable::draw
