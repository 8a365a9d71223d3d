// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>

namespace palpable::sources {

/// The coding of a renderer's depth buffer (Gomez 2012, chapter 5, takes depth from there).
struct ZBuffer {
  enum class Range : std::uint8_t {
    /// OpenGL's window depth, Direct3D, Vulkan, and integer files.
    zero_to_one,
    /// OpenGL's normalised device coordinates.
    minus_one_to_one
  };
  enum class Order : std::uint8_t {
    near_is_small,
    /// "Reversed Z": 1 (the range's upper end) at the near plane.
    near_is_large
  };
  enum class Projection : std::uint8_t { perspective, orthographic };
  enum class FarPlane : std::uint8_t {
    /// Cleared pixels, on which nothing was drawn, are unknown.
    is_empty,
    is_a_surface
  };

  /// Distances of the planes along the camera's axis. 0 < near_m < far_m; far_m may be infinite for a
  /// perspective.
  double near_m = 0.0;
  double far_m = 0.0;
  Range range = Range::zero_to_one;
  Order order = Order::near_is_small;
  Projection projection = Projection::perspective;
  FarPlane far_plane = FarPlane::is_empty;
};

/// Converts the values of a depth buffer to depth along the camera's axis, metres; NaN where nothing was
/// drawn and for values outside the range. With z from 0 (near n) to 1 (far f), a perspective projection
/// stores z = f/(f−n)·(1 − n/Z), so Z = n·f/(f − z·(f−n)); an orthographic projection stores depth linearly.
/// Errors: usage for impossible planes.
Result<Raster<float>> linearise_zbuffer(const Raster<float>& values, const ZBuffer& buffer);

}  // namespace palpable::sources
