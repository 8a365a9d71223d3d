// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

namespace palpable::draw {

class Canvas;

/// A drawing as a function: paint() draws it on a white page of this size.
struct Figure {
  int width_px = 0;
  int height_px = 0;
  std::function<void(Canvas&)> paint;
};

/// Writes the figure in the format of the file name's extension: .png, .svg or .pdf (one pixel is 1/96 inch
/// in the last two). The file is written atomically. Errors: usage for another extension, failed if it cannot
/// be written.
Result<void> write_figure(const Figure& figure, const std::filesystem::path& path);

/// The figure as a PNG file in memory. Errors: failed if it cannot be drawn.
Result<std::vector<std::byte>> png_of(const Figure& figure);

}  // namespace palpable::draw
