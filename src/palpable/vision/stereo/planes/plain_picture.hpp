// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/image/colour_planes.hpp"

// For tests only.
namespace palpable::vision {

/// A picture of one colour.
inline ColourPlanes plain_picture(int width, int height) {
  const Raster<std::uint8_t> plane(width, height, std::uint8_t{90});
  return {plane, plane, plane};
}

}  // namespace palpable::vision
