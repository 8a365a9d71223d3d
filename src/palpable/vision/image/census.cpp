// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/census.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <vector>

namespace palpable::vision {
namespace {

/// The bits of one row of the window, nine per pixel, in short lanes so that many fit in a vector.
using RowBits = std::vector<std::uint16_t>;

PALPABLE_VECTORIZE void add_darker(const std::uint8_t* __restrict other,
                                   const std::uint8_t* __restrict centre, int width,
                                   std::uint16_t* __restrict bits) {
  for (int x = 0; x < width; ++x)
    bits[x] = static_cast<std::uint16_t>((unsigned{bits[x]} << 1U) | (other[x] < centre[x] ? 1U : 0U));
}

PALPABLE_VECTORIZE void add_similar(const std::uint8_t* __restrict difference, std::uint8_t limit, int width,
                                    std::uint16_t* __restrict bits) {
  for (int x = 0; x < width; ++x)
    bits[x] = static_cast<std::uint16_t>((unsigned{bits[x]} << 1U) | (difference[x] < limit ? 1U : 0U));
}

/// Moves the bits of a row of the window to the end of the signatures, and clears them.
PALPABLE_VECTORIZE void append(std::uint16_t* __restrict bits, int width, std::uint64_t* __restrict out) {
  for (int x = 0; x < width; ++x) {
    out[x] = (out[x] << (2 * kCensusHalfX + 1)) | bits[x];
    bits[x] = 0;
  }
}

}  // namespace

std::vector<Parameter> parameters_of(CensusOptions& o) {
  return {{"similar_levels",
           &o.similar_levels,
           {1, 255},
           "levels",
           "Pixels of the window that differ by less are compared"},
          {"fewest_similar", &o.fewest_similar, {1, 63}, "px", "If fewer are similar, all are compared"}};
}

Raster<std::uint64_t> similar_pixels_9x7(const ColourPlanes& picture, const CensusOptions& options,
                                         const Work& work) {
  const auto levels = static_cast<std::uint8_t>(options.similar_levels);
  constexpr std::uint64_t kAll = (std::uint64_t{1} << kCensusPixels) - 1;
  Raster<std::uint64_t> out(picture.width(), picture.height());
  const int width = out.width();
  parallel_for(work, out.height(), 16, [&](int begin, int end) {
    std::vector<std::uint8_t> difference(static_cast<std::size_t>(width));
    RowBits bits(difference.size());
    for (int y = begin; y < end; ++y) {
      for (int v = -kCensusHalfY; v <= kCensusHalfY; ++v) {
        for (int u = -kCensusHalfX; u <= kCensusHalfX; ++u) {
          // Beyond the border all pixels are compared, since the census repeats the border.
          std::fill(difference.begin(), difference.end(), std::uint8_t{0});
          const int first = std::max(0, -u);
          if (y + v >= 0 && y + v < out.height())
            colour_differences(picture, first, y, first + u, y + v, std::min(width, width - u) - first,
                               difference.data() + first);
          add_similar(difference.data(), levels, width, bits.data());
        }
        append(bits.data(), width, out.row(y).data());
      }
      for (std::uint64_t& mask : out.row(y))
        if (std::popcount(mask) < options.fewest_similar) mask = kAll;
    }
  });
  return out;
}

Raster<std::uint64_t> census_9x7(const Raster<std::uint8_t>& grey, const Work& work) {
  Raster<std::uint8_t> padded(grey.width() + 2 * kCensusHalfX, grey.height() + 2 * kCensusHalfY);
  for (int y = 0; y < padded.height(); ++y)
    for (int x = 0; x < padded.width(); ++x)
      padded(x, y) = grey(std::clamp(x - kCensusHalfX, 0, grey.width() - 1),
                          std::clamp(y - kCensusHalfY, 0, grey.height() - 1));
  Raster<std::uint64_t> out(grey.width(), grey.height());
  parallel_for(work, grey.height(), 16, [&](int begin, int end) {
    RowBits bits(static_cast<std::size_t>(grey.width()));
    for (int y = begin; y < end; ++y) {
      const std::uint8_t* centre = padded.row(y + kCensusHalfY).data() + kCensusHalfX;
      for (int v = 0; v <= 2 * kCensusHalfY; ++v) {
        for (int u = 0; u <= 2 * kCensusHalfX; ++u)
          add_darker(padded.row(y + v).data() + u, centre, grey.width(), bits.data());
        append(bits.data(), grey.width(), out.row(y).data());
      }
    }
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
  if (x < kCensusHalfX || y < kCensusHalfY || x >= picture.width() - kCensusHalfX ||
      y >= picture.height() - kCensusHalfY)
    return false;
  const int centre = picture(x, y);
  int spread = 0;
  for (int v = -kCensusHalfY; v <= kCensusHalfY; ++v)
    for (int u = -kCensusHalfX; u <= kCensusHalfX; ++u) spread += std::abs(picture(x + u, y + v) - centre);
  return spread > kTextureLevels * kCensusPixels;
}

}  // namespace palpable::vision
