// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/check.hpp"
#include "palpable/vision/segmentation/background.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace palpable::vision {
namespace {

/// First and last ground pixel of a row or column; none: last < first.
struct Span {
  int first = std::numeric_limits<int>::max();
  int last = -1;
  void take(int at) {
    first = std::min(first, at);
    last = std::max(last, at);
  }
  bool surrounds(int at) const { return at > first && at < last; }
};

/// The rows' and columns' extents of the ground.
struct GroundExtent {
  std::vector<Span> rows, columns;
  explicit GroundExtent(const Raster<std::uint8_t>& mask)
      : rows(static_cast<std::size_t>(mask.height())), columns(static_cast<std::size_t>(mask.width())) {
    for (int y = 0; y < mask.height(); ++y)
      for (int x = 0; x < mask.width(); ++x) {
        if (mask(x, y) == 0) continue;
        rows[static_cast<std::size_t>(y)].take(x);
        columns[static_cast<std::size_t>(x)].take(y);
      }
  }
  bool surrounds(int x, int y) const {
    return rows[static_cast<std::size_t>(y)].surrounds(x) ||
           columns[static_cast<std::size_t>(x)].surrounds(y);
  }
};

/// The ground's disparity at its far end, without the farthest 1 % of its pixels.
double far_end_px(const Ground& ground) {
  std::vector<double> seen;
  for (int y = 0; y < ground.mask.height(); ++y)
    for (int x = 0; x < ground.mask.width(); ++x)
      if (ground.mask(x, y) != 0) seen.push_back(ground.plane.at(x, y));
  if (seen.empty()) return std::numeric_limits<double>::infinity();
  const auto end = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 100);
  std::nth_element(seen.begin(), end, seen.end());
  return *end;
}

/// Flood fill of surfaces over pixels off the ground.
class Surfaces {
 public:
  Surfaces(const Ground& ground, const Raster<float>& disparity_px, double nearest_px, double step_px)
      : ground_(ground), disparity_px_(disparity_px), least_px_(nearest_px), step_px_(step_px) {}

  /// Adds the component of the seed that is nearer than the ground's far end to `out`, and returns its
  /// pixels.
  std::vector<std::pair<int, int>> grow(int x, int y, Raster<std::uint8_t>& out) const {
    std::vector<std::pair<int, int>> all{{x, y}};
    out(x, y) = 255;
    for (std::size_t k = 0; k < all.size(); ++k) {
      constexpr std::array<std::pair<int, int>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
      const auto [a, b] = all[k];
      for (const auto& [da, db] : kBeside) {
        const int c = a + da, d = b + db;
        if (!out.contains(c, d) || out(c, d) != 0 || ground_.mask(c, d) != 0) continue;
        const double there = disparity_px_(c, d);
        if (!(there > least_px_ && std::abs(there - static_cast<double>(disparity_px_(a, b))) <= step_px_))
          continue;
        out(c, d) = 255;
        all.emplace_back(c, d);
      }
    }
    return all;
  }

 private:
  const Ground& ground_;
  const Raster<float>& disparity_px_;
  double least_px_, step_px_;
};

}  // namespace

Raster<std::uint8_t> objects_on_ground(const Ground& ground, const Raster<float>& disparity_px,
                                       const BackgroundMaskOptions& options) {
  PALPABLE_CHECK(ground.mask.width() == disparity_px.width() &&
                 ground.mask.height() == disparity_px.height());
  const double height_px = std::max(options.least_height_px, options.height_sigmas * ground.rms_px);
  const GroundExtent extent(ground.mask);
  const Surfaces surfaces(ground, disparity_px, far_end_px(ground) + height_px, options.step_px);
  const double least_pixels = options.least_object_share * static_cast<double>(disparity_px.count());
  Raster<std::uint8_t> out(disparity_px.width(), disparity_px.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const double above = disparity_px(x, y) - ground.plane.at(x, y);
      const bool hides =
          out(x, y) == 0 && ground.mask(x, y) == 0 && above > height_px && extent.surrounds(x, y);
      if (!hides) continue;
      const auto grown = surfaces.grow(x, y, out);
      if (static_cast<double>(grown.size()) < least_pixels)
        for (const auto& [a, b] : grown) out(a, b) = 0;
    }
  // Unknown pixels, and those between the ground and an object, are not behind it either.
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const double above = disparity_px(x, y) - ground.plane.at(x, y);
      if (ground.mask(x, y) == 0 && extent.surrounds(x, y) && !(above < -height_px)) out(x, y) = 255;
    }
  return out;
}

}  // namespace palpable::vision
