// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/field.hpp"

namespace palpable::models {

/// A solid's heights (z in the scene's frame) seen from above over its own box, in pixels of `pixel_m` > 0,
/// at most 4096 a side: finer than SolidField::from_above, which is centred on the scene's origin. The view's
/// origin is the middle of the box. Where there is nothing, heights are those of the box's lowest side. With
/// pixels no larger than the field's cells, everything that the field holds appears in it. All threads.
Relief solid_view(const Field& solid, double pixel_m);
Relief solid_view(const FieldOnLattice& solid, double pixel_m);

}  // namespace palpable::models
