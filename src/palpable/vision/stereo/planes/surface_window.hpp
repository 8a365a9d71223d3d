// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/planes/planes.hpp"

#include <algorithm>
#include <array>
#include <vector>

// Sums over windows around every pixel of a row, restricted to the pixel's own surface by weights.
namespace palpable::vision {

struct Offset {
  int x, y;
};

/// Pointers to one row of a plane map and of its picture.
struct SurfaceRow {
  const float* disparity;
  const float* slope_x;
  const float* slope_y;
  const float* weight;
  const std::uint8_t* r;
  const std::uint8_t* g;
  const std::uint8_t* b;
};

/// The data of row y from column x on.
SurfaceRow surface_row(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight, int x,
                       int y);

/// The weights of the pixels at `offset` for those of `centre`: their own weight, times factors for colour
/// similarity and for the distance from the centre's plane (see FitWindow). `rise[i]`: their disparity minus
/// the centre's. Vectorised.
void surface_weights(const SurfaceRow& centre, const SurfaceRow& other, Offset offset,
                     const FitWindow& window, int count, float* weight, float* rise);

/// Sums of a row, one value per pixel each.
template <std::size_t kSums>
struct RowSums {
  std::array<std::vector<float>, kSums> of;
  explicit RowSums(int width) {
    for (auto& s : of) s.resize(static_cast<std::size_t>(width));
  }
  void clear() {
    for (auto& s : of) std::fill(s.begin(), s.end(), 0.0F);
  }
};

/// Calls add(offset, first, count) for every offset of the window around row y: the pixels first …
/// first + count - 1 of the row have a pixel at that offset inside the picture.
template <class Add>
void over_window(const FitWindow& window, int width, int height, int y, const Add& add) {
  for (int dy = -window.radius_px; dy <= window.radius_px; dy += window.step_px) {
    if (y + dy < 0 || y + dy >= height) continue;
    for (int dx = -window.radius_px; dx <= window.radius_px; dx += window.step_px) {
      const int first = std::max(0, -dx);
      const int count = std::min(width, width - dx) - first;
      if (count > 0) add(Offset{dx, dy}, first, count);
    }
  }
}

/// For every row y: the sums over the window around each of its pixels, then done(sums, y). add(first,
/// offset, count, weights, rises, sums) adds to the sums of the `count` pixels from `first` on those at the
/// offset, whose weights and rises are as surface_weights() says.
template <std::size_t kSums, class Add, class Done>
void sum_over_surfaces(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight,
                       const FitWindow& window, const Work& work, const Add& add, const Done& done) {
  const int w = colour.width();
  const int h = colour.height();
  parallel_for(work, h, 8, [&](int begin, int end) {
    RowSums<kSums> sums(w);
    std::vector<float> weights(static_cast<std::size_t>(w));
    std::vector<float> rises(static_cast<std::size_t>(w));
    for (int y = begin; y < end; ++y) {
      sums.clear();
      over_window(window, w, h, y, [&](Offset offset, int first, int count) {
        surface_weights(surface_row(colour, map, weight, first, y),
                        surface_row(colour, map, weight, first + offset.x, y + offset.y), offset, window,
                        count, weights.data(), rises.data());
        add(Pixel{first, y}, offset, count, weights.data(), rises.data(), sums);
      });
      done(sums, y);
    }
  });
}

}  // namespace palpable::vision
