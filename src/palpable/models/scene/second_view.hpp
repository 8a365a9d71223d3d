// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"

#include <cstdint>

namespace palpable::models {

/// The right picture of the pair whose left one is a relief's texture, and where it shows each place of the
/// surface: what a right eye sees. A value type.
struct SecondView {
  /// A file keeps it as a JPEG, so it changes a little with each saving.
  Raster<Rgb8> picture;
  /// Over the scene's rectangle: shift_share() of its values is how much farther left than in the texture the
  /// second picture shows a place, as a share of the pictures' width.
  Raster<std::uint16_t> shift;
};

/// -1 ... 1.
inline constexpr double kShiftScale = 32768.0;
constexpr float shift_share(std::uint16_t value) {
  return static_cast<float>((static_cast<double>(value) - kShiftScale) / kShiftScale);
}

}  // namespace palpable::models
