// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contour_channels.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace palpable::vision {
namespace {

/// The n-th root (3 or 5) of a positive normal number with a relative error of 3e-7. A float's bits
/// approximate its logarithm, which gives the start for Newton's method. OpenCV's conversion first fills
/// exact tables, which takes longer than converting one picture.
template <int kRoot>
inline __attribute__((always_inline)) float root_of(float v) {
  constexpr float kOne = 0x3F800000p0F;
  const float bits = static_cast<float>(std::bit_cast<std::int32_t>(v));
  float root = std::bit_cast<float>(static_cast<std::int32_t>((bits - kOne) / kRoot + kOne));
  for (int step = 0; step < 3; ++step) {
    const float square = root * root;
    const float power = kRoot == 3 ? square : square * square;
    root += (v / power - root) / kRoot;
  }
  return root;
}

/// A branch-free selection, so that the loop can be vectorised.
inline __attribute__((always_inline)) float either(bool first, float one, float other) {
  const float share = first ? 1.0F : 0.0F;
  return share * one + (1.0F - share) * other;
}

/// sRGB (IEC 61966-2-1) to linear light, 0 … 1.
inline __attribute__((always_inline)) float linear_of(float v) {
  const float base = (v + 0.055F) * (1.0F / 1.055F);
  const float fifth = root_of<5>(base);
  return either(v <= 0.04045F, v * (1.0F / 12.92F), base * base * fifth * fifth);
}

/// The cube root of CIELAB, with its straight piece at the dark end.
inline __attribute__((always_inline)) float lightness_of(float t) {
  constexpr float kDark = 216.0F / 24389.0F;
  return either(t <= kDark, t * (24389.0F / 27.0F / 116.0F) + 16.0F / 116.0F, root_of<3>(t + 1e-9F));
}

/// Converts a row of sRGB to L, a and b in place (CIE 15:2004), each divided by 100.
PALPABLE_VECTORIZE
void lab_row(float* __restrict first, float* __restrict second, float* __restrict third, int n) {
  for (int x = 0; x < n; ++x) {
    const float r = linear_of(first[x]), g = linear_of(second[x]), b = linear_of(third[x]);
    const float fx = lightness_of((0.412453F * r + 0.357580F * g + 0.180423F * b) / 0.950456F);
    const float fy = lightness_of(0.212671F * r + 0.715160F * g + 0.072169F * b);
    const float fz = lightness_of((0.019334F * r + 0.119193F * g + 0.950227F * b) / 1.088754F);
    first[x] = 1.16F * fy - 0.16F;
    second[x] = 5.0F * (fx - fy);
    third[x] = 2.0F * (fy - fz);
  }
}

/// Scale and offset that map the two quantiles of the colour samples to 0 and 1; identity for 8-bit pictures.
std::pair<float, float> stretch_of(const Image& image, const ChannelOptions& options) {
  if (image.bits <= 8) return {1.0F, 0.0F};
  std::vector<float> sample;
  const std::size_t step = std::max<std::size_t>(1, image.samples.size() / 200000);
  for (std::size_t i = 0; i < image.samples.size(); i += step) {
    const auto channel = static_cast<int>(i % static_cast<std::size_t>(image.channels));
    if (image.channels % 2 == 0 && channel == image.channels - 1) continue;
    sample.push_back(image.samples[i]);
  }
  const float low = quantile_of(sample, options.low_quantile);
  const float high = quantile_of(sample, options.high_quantile);
  return high > low ? std::pair{1.0F / (high - low), -low / (high - low)} : std::pair{1.0F, 0.0F};
}

}  // namespace

std::vector<WeightedChannel> edge_channels(const Image& image, const ChannelOptions& options,
                                           const Work& work) {
  const auto [scale, offset] = stretch_of(image, options);
  const bool colour = image.channels >= 3;
  const bool alpha = image.channels % 2 == 0;
  std::vector<WeightedChannel> out;
  out.reserve(3);
  for (int c = 0; c < (colour ? 3 : 1); ++c)
    out.push_back({Raster<float>(image.width, image.height), c == 0 ? 1.0F : options.chroma_weight});
  parallel_for(work, image.height, 16, [&, scale = scale, offset = offset](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (std::size_t c = 0; c < out.size(); ++c) {
        float* const row = out[c].values.row(y).data();
        for (int x = 0; x < image.width; ++x) {
          const float* p = image.pixel(x, y);
          const float opaque = alpha ? std::clamp(p[image.channels - 1], 0.0F, 1.0F) : 1.0F;
          row[x] = std::clamp(p[c] * scale + offset, 0.0F, 1.0F) * opaque + (1.0F - opaque);
        }
      }
      if (colour)
        lab_row(out[0].values.row(y).data(), out[1].values.row(y).data(), out[2].values.row(y).data(),
                image.width);
    }
  });
  return out;
}

}  // namespace palpable::vision
