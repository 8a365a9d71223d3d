// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drawn_maps.hpp"
#include <cairo/cairo.h>

namespace palpable::bench {

/// Writes the names of streets along them, curved as they are, where there is room: those that are drawn
/// whole, each of which may be there several times. Nothing is written too near to `taken`.
std::vector<DrawnName> draw_street_names(cairo_t* cr, const std::vector<DrawnWay>& ways,
                                         const DrawnMapStyle& style, int side, std::vector<TakenPlace> taken);

}  // namespace palpable::bench
