// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace palpable::vision {

/// A colour picture as three planes, so that loops over a row run in vectors.
struct ColourPlanes {
  Raster<std::uint8_t> r;
  Raster<std::uint8_t> g;
  Raster<std::uint8_t> b;

  int width() const { return r.width(); }
  int height() const { return r.height(); }
  /// The greatest difference of the three channels between two pixels, 0…255.
  int difference(int x0, int y0, int x1, int y1) const {
    const int dr = std::abs(int{r(x0, y0)} - int{r(x1, y1)});
    const int dg = std::abs(int{g(x0, y0)} - int{g(x1, y1)});
    const int db = std::abs(int{b(x0, y0)} - int{b(x1, y1)});
    return std::max(std::max(dr, dg), db);
  }
};

/// differences[i] becomes the difference, as above, of the pixels (x0 + i, y0) and (x1 + i, y1). Runs in
/// vectors.
void colour_differences(const ColourPlanes& picture, int x0, int y0, int x1, int y1, int count,
                        std::uint8_t* differences);

/// The raster mirrored horizontally. Matching a stereo pair with its right picture as reference equals
/// matching the mirrored pair with its left one.
template <class T>
Raster<T> mirrored(const Raster<T>& raster) {
  Raster<T> out(raster.width(), raster.height());
  for (int y = 0; y < raster.height(); ++y)
    std::reverse_copy(raster.row(y).begin(), raster.row(y).end(), out.row(y).begin());
  return out;
}

inline ColourPlanes mirrored(const ColourPlanes& p) { return {mirrored(p.r), mirrored(p.g), mirrored(p.b)}; }

inline ColourPlanes colour_planes(const Raster<Rgb8>& picture) {
  const int w = picture.width();
  const int h = picture.height();
  ColourPlanes out{Raster<std::uint8_t>(w, h), Raster<std::uint8_t>(w, h), Raster<std::uint8_t>(w, h)};
  for (std::size_t i = 0; i < picture.count(); ++i) {
    const Rgb8 p = picture.values()[i];
    out.r.values()[i] = p.r;
    out.g.values()[i] = p.g;
    out.b.values()[i] = p.b;
  }
  return out;
}

}  // namespace palpable::vision
