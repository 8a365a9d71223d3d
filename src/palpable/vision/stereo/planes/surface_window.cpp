// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/surface_window.hpp"

#include <algorithm>
#include <cstdint>

namespace palpable::vision {

template <class T>
PaddedPlane::PaddedPlane(const Raster<T>& values, int margin, const Work& work)
    : margin_(margin), stride_(static_cast<std::size_t>(values.width() + 2 * margin + kSurfaceLanes)) {
  values_.resize(stride_ * static_cast<std::size_t>(values.height()));
  parallel_for(work, values.height(), 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      std::copy(values.row(y).begin(), values.row(y).end(),
                values_.begin() + static_cast<std::ptrdiff_t>(at(0, y)));
  });
}
template PaddedPlane::PaddedPlane(const Raster<float>&, int, const Work&);
template PaddedPlane::PaddedPlane(const Raster<std::uint8_t>&, int, const Work&);

SurfaceWindows::SurfaceWindows(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight_,
                               const FitWindow& window_, const Work& work)
    : window(window_),
      width(colour.width()),
      height(colour.height()),
      disparity(map.disparity, window.radius_px, work),
      slope_x(map.slope_x, window.radius_px, work),
      slope_y(map.slope_y, window.radius_px, work),
      weight(weight_, window.radius_px, work),
      r(colour.r, window.radius_px, work),
      g(colour.g, window.radius_px, work),
      b(colour.b, window.radius_px, work) {}

}  // namespace palpable::vision
