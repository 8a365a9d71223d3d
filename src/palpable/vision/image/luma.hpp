// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <algorithm>
#include <cstdint>

namespace palpable::vision {

/// The luma (Rec. 601) of an 8-bit picture, rounded.
inline Raster<std::uint8_t> luma8(const Raster<Rgb8>& picture) {
  Raster<std::uint8_t> out(picture.width(), picture.height());
  std::transform(picture.values().begin(), picture.values().end(), out.values().begin(), [](Rgb8 p) {
    return static_cast<std::uint8_t>((299 * p.r + 587 * p.g + 114 * p.b + 500) / 1000);
  });
  return out;
}

}  // namespace palpable::vision
