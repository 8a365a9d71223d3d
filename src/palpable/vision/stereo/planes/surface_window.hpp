// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/planes/planes.hpp"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <vector>

// Sums over windows around every pixel of a row, restricted to the pixel's own surface by weights. The loops
// run over eight pixels at a time and keep their sums in registers.
namespace palpable::vision {

/// A picture's values as floats, with a margin at both ends of each row.
class PaddedPlane {
 public:
  /// `margin`: columns before the first and, rounded up to whole lanes, after the last one; their value is 0.
  template <class T>
  PaddedPlane(const Raster<T>& values, int margin, const Work& work);

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(margin_ + x);
  }
  const float* data() const { return values_.data(); }

 private:
  int margin_;
  std::size_t stride_;
  std::vector<float> values_;
};

/// Pixels of a row that are computed together, one in each lane: a register of AVX2.
inline constexpr int kSurfaceLanes = 8;
using SurfaceLanes = float __attribute__((vector_size(sizeof(float) * kSurfaceLanes)));
using SurfaceMasks = int __attribute__((vector_size(sizeof(float) * kSurfaceLanes)));

/// What the windows around a picture's pixels contain. `weight` is each pixel's own, 0…1; pixels outside the
/// picture have none.
struct SurfaceWindows {
  SurfaceWindows(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight,
                 const FitWindow& window, const Work& work);

  FitWindow window;
  int width, height;
  PaddedPlane disparity, slope_x, slope_y, weight, r, g, b;
};

/// The pixels in the middle of kSurfaceLanes windows.
struct SurfaceCentres {
  SurfaceLanes disparity, slope_x, slope_y, r, g, b;
};

/// The offset of a window's pixel, and the reciprocals of the tolerance there and of the squared colour
/// scale.
struct WindowOffset {
  float dx, dy;
  float per_tolerance, per_colour2;
};

inline __attribute__((always_inline)) void load(const PaddedPlane& plane, std::size_t at, SurfaceLanes& out) {
  std::memcpy(&out, plane.data() + at, sizeof out);
}

inline __attribute__((always_inline)) void load_centres(const SurfaceWindows& windows, int x, int y,
                                                        SurfaceCentres& out) {
  const std::size_t at = windows.disparity.at(x, y);
  load(windows.disparity, at, out.disparity);
  load(windows.slope_x, at, out.slope_x);
  load(windows.slope_y, at, out.slope_y);
  load(windows.r, at, out.r);
  load(windows.g, at, out.g);
  load(windows.b, at, out.b);
}

inline __attribute__((always_inline)) void magnitude(SurfaceLanes& values) {
  values = reinterpret_cast<SurfaceLanes>(reinterpret_cast<SurfaceMasks>(values) & 0x7fffffff);
}

/// The weights of the pixels from `at` on for the centres whose windows they are in: their own weight, times
/// factors for colour similarity and for the distance from the centre's plane (see FitWindow). `rise`: their
/// disparity minus the centre's.
inline __attribute__((always_inline)) void weigh(const SurfaceWindows& windows, const SurfaceCentres& centre,
                                                 const WindowOffset& offset, std::size_t at,
                                                 SurfaceLanes& weight, SurfaceLanes& rise) {
  SurfaceLanes red, green, blue;
  load(windows.disparity, at, rise);
  load(windows.weight, at, weight);
  load(windows.r, at, red);
  load(windows.g, at, green);
  load(windows.b, at, blue);
  rise -= centre.disparity;
  SurfaceLanes departure = rise - (centre.slope_x * offset.dx + centre.slope_y * offset.dy);
  magnitude(departure);
  red -= centre.r;
  green -= centre.g;
  blue -= centre.b;
  magnitude(red);
  magnitude(green);
  magnitude(blue);
  SurfaceLanes colour = red > green ? red : green;
  colour = colour > blue ? colour : blue;
  colour = colour * colour * offset.per_colour2;
  const SurfaceLanes zero = {};
  const SurfaceLanes near = 1.0F - departure * offset.per_tolerance;
  weight = (near > zero ? near : zero) * weight / (1.0F + colour * colour);
}

/// Calls visit(offset, at) for the window of the pixels x, x + 1, … of row y: `at` is where its pixels begin
/// in the padded planes. Rows outside the picture are left out.
template <class Visit>
inline __attribute__((always_inline)) void over_window(const SurfaceWindows& windows, int x, int y,
                                                       const Visit& visit) {
  const FitWindow& window = windows.window;
  const float per_colour2 = 1.0F / (window.half_weight_levels * window.half_weight_levels);
  for (int dy = -window.radius_px; dy <= window.radius_px; dy += window.step_px) {
    if (y + dy < 0 || y + dy >= windows.height) continue;
    const auto rows = static_cast<float>(std::abs(dy));
    for (int dx = -window.radius_px; dx <= window.radius_px; dx += window.step_px) {
      const auto columns = static_cast<float>(std::abs(dx));
      const float per_tolerance = 1.0F / (window.tolerance_px + window.tolerance_per_px * (columns + rows));
      visit(WindowOffset{static_cast<float>(dx), static_cast<float>(dy), per_tolerance, per_colour2},
            windows.disparity.at(x + dx, y + dy));
    }
  }
}

/// Sums over the windows of a row's pixels, one row for each; in whole lanes.
template <std::size_t kSums>
struct RowSums {
  std::array<std::vector<float>, kSums> of;
  explicit RowSums(int width) {
    for (auto& s : of) s.resize(static_cast<std::size_t>(width + kSurfaceLanes));
  }
  void store(int x, const SurfaceLanes (&sums)[kSums]) {
    for (std::size_t k = 0; k < kSums; ++k) std::memcpy(of[k].data() + x, &sums[k], sizeof sums[k]);
  }
};

}  // namespace palpable::vision
