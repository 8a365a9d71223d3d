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

struct Pixel {
  int x, y;
};

int difference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// How like a pixel the sure ones of a side are, and how many they are.
struct Likeness {
  float sum = 0.0F;
  int pixels = 0;
  /// The density of the side's colours at the pixel's, 0 … 1; a little more than none where there is none.
  float density() const {
    constexpr float kLeast = 0.01F;
    return kLeast + (pixels > 0 ? sum / static_cast<float>(pixels) : 0.0F);
  }
};

class Judge {
 public:
  Judge(const Raster<Rgb8>& picture, const Raster<Side>& side) : picture_(picture), side_(side) {
    constexpr float kLikeColour = 8.0F;
    for (std::size_t i = 0; i < weight_.size(); ++i)
      weight_[i] = std::exp(-static_cast<float>(i) / kLikeColour);
  }

  /// The pixel's side: inside or outside, or what it was where too few sure pixels are around.
  Side verdict(Pixel p) const {
    constexpr int kReach_px = 24;
    constexpr int kStep_px = 2;
    constexpr int kFewest = 24;
    constexpr float kClearly = 5.0F;
    Likeness inside;
    Likeness outside;
    for (int v = p.y - kReach_px; v <= p.y + kReach_px; v += kStep_px)
      for (int u = p.x - kReach_px; u <= p.x + kReach_px; u += kStep_px) {
        if (!side_.contains(u, v)) continue;
        const Side there = side_(u, v);
        if (there != Side::inside && there != Side::outside) continue;
        Likeness& of = there == Side::inside ? inside : outside;
        of.sum += weight_[static_cast<std::size_t>(difference(picture_(p.x, p.y), picture_(u, v)))];
        ++of.pixels;
      }
    const Side before = side_(p.x, p.y);
    if (inside.pixels + outside.pixels < kFewest) return before;
    float in = inside.density();
    float out = outside.density();
    if (before == Side::perhaps_inside) in *= kClearly;
    if (before == Side::perhaps_outside) out *= kClearly;
    return in > out ? Side::inside : Side::outside;
  }

 private:
  const Raster<Rgb8>& picture_;
  const Raster<Side>& side_;
  std::array<float, 256> weight_{};
};

}  // namespace

void decide_by_colour(const Raster<Rgb8>& picture, Raster<Side>& side, const Work& work) {
  PALPABLE_CHECK(picture.width() == side.width() && picture.height() == side.height());
  const Judge judge(picture, side);
  std::vector<Pixel> left;
  for (int y = 0; y < side.height(); ++y)
    for (int x = 0; x < side.width(); ++x)
      if (side(x, y) != Side::inside && side(x, y) != Side::outside) left.push_back({x, y});
  for (bool reached = true; reached && !work.cancelled();) {
    std::vector<Side> found(left.size());
    parallel_for(work, static_cast<int>(left.size()), 256, [&](int begin, int end) {
      for (int i = begin; i < end; ++i)
        found[static_cast<std::size_t>(i)] = judge.verdict(left[static_cast<std::size_t>(i)]);
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
