// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::models {

/// Upper bounds of a cubic B-spline height field over rectangles: the greatest control value of blocks of
/// 4 x 4 pixels, and of blocks twice as wide at each further level (a max-pyramid). Immutable; any thread.
class HeightBounds {
 public:
  HeightBounds() = default;
  /// The spline's control values, at least one.
  explicit HeightBounds(const Raster<float>& control_values);

  /// No place of the surface with x0 <= x <= x1 and y0 <= y <= y1 is higher. In pixels, sample centres at
  /// integers, any finite values, x0 <= x1 and y0 <= y1. Reads four values at most. Tick path.
  float highest_in(double x0_px, double y0_px, double x1_px, double y1_px) const noexcept;

  std::size_t memory_bytes() const noexcept { return bounds_.size() * sizeof(float); }

 private:
  static constexpr int kBlock_px = 4;

  struct Level {
    std::size_t begin = 0;
    int width = 0;
    int height = 0;
  };

  std::vector<float> bounds_;
  std::vector<Level> levels_;
};

}  // namespace palpable::models
