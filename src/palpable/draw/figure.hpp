// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <filesystem>
#include <functional>

namespace palpable::draw {

class Canvas;

/// A drawing that is not yet on paper: what paint() puts on a white page of this size.
struct Figure {
  int width_px = 0;
  int height_px = 0;
  std::function<void(Canvas&)> paint;
};

/// Writes the figure as the file's name ends: .png, .svg or .pdf (a pixel is 1/96 inch there). The file
/// appears whole or not at all. Errors: usage for another ending, failed if it cannot be written.
Result<void> write_figure(const Figure& figure, const std::filesystem::path& path);

}  // namespace palpable::draw
