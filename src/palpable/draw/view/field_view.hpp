// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"
#include "palpable/models/field/field.hpp"

#include <memory>

namespace palpable::draw {

struct FieldSectionOptions {
  /// Outlines the leaves of the field's octree; a dense field has none.
  bool cells = false;
};

/// A section through a solid in the plane y = `y_m`, seen from below: the signed distance near the surface in
/// colours with iso-distance lines, and the force of a spring inside.
Figure field_section_figure(std::shared_ptr<const models::Field> field, double y_m,
                            const FieldSectionOptions& options, const FigureTitle& title);
Figure field_section_figure(std::shared_ptr<const models::FieldOnLattice> field, double y_m,
                            const FieldSectionOptions& options, const FigureTitle& title);

}  // namespace palpable::draw
