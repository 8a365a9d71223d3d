// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests of figures: reads back painted colours.

#include "palpable/draw/canvas/canvas.hpp"
#include "palpable/draw/canvas/figure.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>

#include <cairo.h>
#include <gtest/gtest.h>

namespace palpable::draw {

/// The colour at a point of a figure, which is painted on an image of its size.
inline Rgb8 colour_at(const Figure& figure, CanvasPoint point) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, figure.width_px, figure.height_px),
      &cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()),
                                                                   &cairo_destroy);
  Canvas canvas(context.get());
  canvas.fill({0.0, 0.0, static_cast<double>(figure.width_px), static_cast<double>(figure.height_px)},
              {255, 255, 255});
  figure.paint(canvas);
  EXPECT_STREQ(cairo_status_to_string(cairo_status(context.get())), "no error has occurred");
  cairo_surface_flush(surface.get());
  const auto* row = reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface.get()) +
                                                           static_cast<std::ptrdiff_t>(point.y) *
                                                               cairo_image_surface_get_stride(surface.get()));
  const std::uint32_t p = row[static_cast<std::ptrdiff_t>(point.x)];
  return {static_cast<std::uint8_t>(p >> 16U), static_cast<std::uint8_t>(p >> 8U),
          static_cast<std::uint8_t>(p)};
}

inline double luma(Rgb8 c) { return 0.299 * c.r + 0.587 * c.g + 0.114 * c.b; }

}  // namespace palpable::draw
