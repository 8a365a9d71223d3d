// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"

#include <memory>

namespace palpable::draw {

/// What was found in a street map, over a pale version of its picture: centre lines, junctions, outlines of
/// buildings and water, and the words that were read. The picture may be empty. `map` must not be null.
Figure map_figure(std::shared_ptr<const StreetMap> map, Raster<Rgb8> picture, double width_m,
                  const FigureTitle& title);

}  // namespace palpable::draw
