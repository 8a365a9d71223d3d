// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/side_by_colour.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace palpable::vision {
namespace {

int difference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Kernel density estimate of a side's colours.
struct ColourDensity {
  float sum = 0.0F;
  int pixels = 0;
  /// 0 … 1, plus `least`.
  float above(float least) const { return least + (pixels > 0 ? sum / static_cast<float>(pixels) : 0.0F); }
};

class SideClassifier {
 public:
  SideClassifier(const Raster<Rgb8>& picture, const Raster<Side>& side, const ColourDecisionOptions& options)
      : picture_(picture), side_(side), options_(options) {
    for (std::size_t i = 0; i < weight_.size(); ++i)
      weight_[i] = std::exp(-static_cast<float>(i) / options.colour_scale);
  }

  /// The pixel's side: inside or outside, or unchanged if there are too few decided pixels nearby.
  Side side_of(Pixel p) const {
    ColourDensity inside;
    ColourDensity outside;
    const int reach = options_.reach_px, step = options_.step_px;
    for (int v = p.y - reach; v <= p.y + reach; v += step)
      for (int u = p.x - reach; u <= p.x + reach; u += step) {
        if (!side_.contains(u, v)) continue;
        const Side there = side_(u, v);
        if (there != Side::inside && there != Side::outside) continue;
        ColourDensity& of = there == Side::inside ? inside : outside;
        of.sum += weight_[static_cast<std::size_t>(difference(picture_(p.x, p.y), picture_(u, v)))];
        ++of.pixels;
      }
    const Side before = side_(p.x, p.y);
    if (inside.pixels + outside.pixels < options_.least_pixels) return before;
    float in = inside.above(options_.least_density);
    float out = outside.above(options_.least_density);
    if (before == Side::perhaps_inside) in *= options_.prior_ratio;
    if (before == Side::perhaps_outside) out *= options_.prior_ratio;
    return in > out ? Side::inside : Side::outside;
  }

 private:
  const Raster<Rgb8>& picture_;
  const Raster<Side>& side_;
  const ColourDecisionOptions& options_;
  std::array<float, 256> weight_{};
};

}  // namespace

void decide_by_colour(const Raster<Rgb8>& picture, Raster<Side>& side, const Work& work,
                      const ColourDecisionOptions& options) {
  PALPABLE_CHECK(picture.width() == side.width() && picture.height() == side.height());
  const SideClassifier classifier(picture, side, options);
  std::vector<Pixel> left;
  for (int y = 0; y < side.height(); ++y)
    for (int x = 0; x < side.width(); ++x)
      if (side(x, y) != Side::inside && side(x, y) != Side::outside) left.push_back({x, y});
  for (bool reached = true; reached && !work.cancelled();) {
    std::vector<Side> found(left.size());
    parallel_for(work, static_cast<int>(left.size()), 256, [&](int begin, int end) {
      for (int i = begin; i < end; ++i)
        found[static_cast<std::size_t>(i)] = classifier.side_of(left[static_cast<std::size_t>(i)]);
    });
    std::vector<Pixel> rest;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (found[i] == Side::inside || found[i] == Side::outside)
        side(left[i].x, left[i].y) = found[i];
      else
        rest.push_back(left[i]);
    }
    reached = rest.size() < left.size();
    left.swap(rest);
  }
}

}  // namespace palpable::vision
