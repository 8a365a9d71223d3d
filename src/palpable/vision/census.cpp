// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/census.hpp"

#include "palpable/core/vectorize.hpp"

#include <algorithm>

namespace palpable::vision {
namespace {

PALPABLE_VECTORIZE void census_row(const Raster<std::uint8_t>& padded, int y, int width, std::uint64_t* out) {
  const std::uint8_t* centre = padded.row(y + kCensusHalfY).data() + kCensusHalfX;
  for (int x = 0; x < width; ++x) out[x] = 0;
  for (int v = 0; v <= 2 * kCensusHalfY; ++v) {
    const std::uint8_t* row = padded.row(y + v).data();
    for (int u = 0; u <= 2 * kCensusHalfX; ++u)
      for (int x = 0; x < width; ++x) out[x] = (out[x] << 1U) | (row[x + u] < centre[x] ? 1U : 0U);
  }
}

}  // namespace

Raster<std::uint64_t> census_9x7(const Raster<std::uint8_t>& grey, const Work& work) {
  Raster<std::uint8_t> padded(grey.width() + 2 * kCensusHalfX, grey.height() + 2 * kCensusHalfY);
  for (int y = 0; y < padded.height(); ++y)
    for (int x = 0; x < padded.width(); ++x)
      padded(x, y) = grey(std::clamp(x - kCensusHalfX, 0, grey.width() - 1),
                          std::clamp(y - kCensusHalfY, 0, grey.height() - 1));
  Raster<std::uint64_t> out(grey.width(), grey.height());
  parallel_for(work, grey.height(), 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) census_row(padded, y, grey.width(), out.row(y).data());
  });
  return out;
}

Raster<std::uint8_t> shrunk(const Raster<std::uint8_t>& picture, int factor) {
  Raster<std::uint8_t> out(picture.width() / factor, picture.height() / factor);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      int sum = 0;
      for (int v = 0; v < factor; ++v)
        for (int u = 0; u < factor; ++u) sum += picture(factor * x + u, factor * y + v);
      out(x, y) = static_cast<std::uint8_t>((sum + factor * factor / 2) / (factor * factor));
    }
  return out;
}

bool has_texture(const Raster<std::uint8_t>& picture, int x, int y) {
  // Contrast that stands above the noise of an 8-bit picture.
  constexpr int kLevels = 4;
  if (x < kCensusHalfX || y < kCensusHalfY || x >= picture.width() - kCensusHalfX ||
      y >= picture.height() - kCensusHalfY)
    return false;
  const int centre = picture(x, y);
  int spread = 0;
  for (int v = -kCensusHalfY; v <= kCensusHalfY; ++v)
    for (int u = -kCensusHalfX; u <= kCensusHalfX; ++u) spread += std::abs(picture(x + u, y + v) - centre);
  return spread > kLevels * kCensusPixels;
}

}  // namespace palpable::vision
