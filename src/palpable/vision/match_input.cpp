// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/match_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::vision {
namespace {

constexpr std::size_t kLevels = 256;
using Levels = std::array<float, kLevels>;

/// The picture's levels at the quantiles 0, 1/255 … 1 of its luma.
Levels quantiles(const Raster<float>& luma) {
  std::vector<float> sorted(luma.values().begin(), luma.values().end());
  std::erase_if(sorted, [](float v) { return !std::isfinite(v); });
  Levels out{};
  if (sorted.empty()) return out;
  // Every pixel of a large picture adds nothing to 256 quantiles.
  const std::size_t step = std::max<std::size_t>(1, sorted.size() / 16384);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sorted.size(); i += step) sorted[kept++] = sorted[i];
  sorted.resize(kept);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t q = 0; q < kLevels; ++q) out[q] = sorted[(sorted.size() - 1) * q / (kLevels - 1)];
  return out;
}

/// `v` mapped by the monotone curve through (from[q], to[q]); beyond its ends the curve goes on in parallel.
float mapped(float v, const Levels& from, const Levels& to) {
  if (v <= from.front()) return to.front() + (v - from.front());
  if (v >= from.back()) return to.back() + (v - from.back());
  const auto above = std::upper_bound(from.begin(), from.end(), v);
  const auto i = static_cast<std::size_t>(above - from.begin());
  const float t = (v - from[i - 1]) / (from[i] - from[i - 1]);
  return to[i - 1] + t * (to[i] - to[i - 1]);
}

/// Levels of both pictures so that `low` becomes 0 and `high` 255.
struct Stretch {
  float low = 0.0F;
  float gain = 255.0F;
  std::uint8_t operator()(float v) const {
    const float level = std::isfinite(v) ? (v - low) * gain : 0.0F;
    return static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F);
  }
};

Stretch stretch_for(const Levels& left, const Levels& right, int bits) {
  // 8-bit pictures are taken as they are unless they are very dark; deeper ones are stretched to what they
  // use.
  const float low = std::min(left[1], right[1]);
  const float high = std::max(left[kLevels - 2], right[kLevels - 2]);
  const bool as_it_is = bits == 8 && high - low > 0.4F;
  if (as_it_is || high <= low) return {};
  return {low, 255.0F / (high - low)};
}

}  // namespace

MatchInput prepare_pictures(const StereoPair& pair, bool* levelled) {
  const Levels left = quantiles(grey(pair.left));
  const Levels right = quantiles(grey(pair.right));
  // The middle of the histograms: their ends move with what only one of the cameras sees.
  float difference = 0.0F;
  for (std::size_t q = 26; q <= 230; ++q) difference += std::abs(left[q] - right[q]) / 205.0F;
  const float used = std::max(left[230] - left[26], right[230] - right[26]);
  const bool differs = difference > 0.08F * used;
  if (levelled != nullptr) *levelled = differs;

  const Stretch stretch = stretch_for(left, differs ? left : right, pair.left.bits);
  const auto convert = [&](const Image& image, bool level, Raster<Rgb8>& colour, Raster<std::uint8_t>& luma) {
    colour = Raster<Rgb8>(image.width, image.height);
    luma = Raster<std::uint8_t>(image.width, image.height);
    const int g = image.channels >= 3 ? 1 : 0;
    const int b = image.channels >= 3 ? 2 : 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const float* p = image.pixel(x, y);
        std::array<float, 3> v{p[0], p[g], p[b]};
        if (level)
          for (float& c : v) c = mapped(c, right, left);
        colour(x, y) = {stretch(v[0]), stretch(v[1]), stretch(v[2])};
        luma(x, y) = stretch(0.299F * v[0] + 0.587F * v[1] + 0.114F * v[2]);
      }
    }
  };
  MatchInput out;
  convert(pair.left, false, out.left, out.left_grey);
  convert(pair.right, differs, out.right, out.right_grey);
  return out;
}

}  // namespace palpable::vision
