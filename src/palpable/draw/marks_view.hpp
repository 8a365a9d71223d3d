// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/draw/figure.hpp"
#include "palpable/draw/heading.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace palpable::draw {

/// What a mark on a picture means, and how it is shown.
struct Mark {
  std::string meaning;
  Rgb8 colour;
};

/// A picture with parts of it tinted: where `marks` (of the picture's size) is k > 0, in kinds[k - 1]'s
/// colour; the legend names each kind with its share of the picture. Axes in pixels; `caption` stands below.
Figure marks_figure(Raster<Rgb8> picture, Raster<std::uint8_t> marks, std::vector<Mark> kinds,
                    const Heading& heading, const std::string& caption);

}  // namespace palpable::draw
