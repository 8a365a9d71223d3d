// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/draw/canvas/figure.hpp"

#include <cstdint>

namespace palpable::draw {

/// A page of A4 with a marker of `side_mm`, a ruler to check the printed size, and how to use it. `cells` are
/// the marker's cells, black = 0. In SVG and PDF the size is exact.
Figure marker_sheet(const Raster<std::uint8_t>& cells, int side_mm);

}  // namespace palpable::draw
