// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace palpable::draw {

/// A kind of mark: its meaning and its colour.
struct Mark {
  std::string meaning;
  Rgb8 colour;
};

/// A picture with tinted parts: where `marks` (same size as the picture) is k > 0, in the colour of kinds[k -
/// 1]. The legend names each kind with its share of the picture. Axes in pixels; `caption` is written below.
Figure marks_figure(Raster<Rgb8> picture, Raster<std::uint8_t> marks, std::vector<Mark> kinds,
                    const FigureTitle& title, const std::string& caption);

}  // namespace palpable::draw
