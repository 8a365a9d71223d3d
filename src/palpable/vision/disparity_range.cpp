// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/disparity_range.hpp"

#include "palpable/core/vectorize.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <optional>
#include <vector>

namespace palpable::vision {
namespace {

constexpr int kCoarseWidth = 224;
constexpr int kHalfX = 4;  // the census window is 9 x 7
constexpr int kHalfY = 3;

/// The picture shrunk by whole pixels, each the mean of factor x factor.
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

struct Signatures {
  Raster<std::uint64_t> bits;
  Raster<std::uint8_t> textured;
};

/// Census signatures; textured where the window's contrast stands above the noise of an 8-bit picture.
Signatures signatures(const Raster<std::uint8_t>& picture) {
  Signatures out{Raster<std::uint64_t>(picture.width(), picture.height()),
                 Raster<std::uint8_t>(picture.width(), picture.height())};
  for (int y = kHalfY; y < picture.height() - kHalfY; ++y)
    for (int x = kHalfX; x < picture.width() - kHalfX; ++x) {
      const int centre = picture(x, y);
      std::uint64_t bits = 0;
      int spread = 0;
      for (int v = -kHalfY; v <= kHalfY; ++v)
        for (int u = -kHalfX; u <= kHalfX; ++u) {
          const int value = picture(x + u, y + v);
          bits = (bits << 1U) | (value < centre ? 1U : 0U);
          spread += std::abs(value - centre);
        }
      out.bits(x, y) = bits;
      out.textured(x, y) = spread > 4 * 63 ? 1 : 0;
    }
  return out;
}

PALPABLE_VECTORIZE void distances(const std::uint64_t* right, std::uint64_t left, int count, int* out) {
  for (int i = 0; i < count; ++i) out[i] = std::popcount(left ^ right[i]);
}

/// For a row: the best column in the other row for each textured column, or -1 where it is not unique.
struct RowMatches {
  std::vector<int> best;
  std::vector<int> cost;
};

void match_row(const Signatures& left, const Signatures& right, int y, RowMatches& forth,
               std::vector<int>& back) {
  const int width = left.bits.width();
  const int first = kHalfX;
  const int count = width - 2 * kHalfX;
  forth.best.assign(static_cast<std::size_t>(width), -1);
  back.assign(static_cast<std::size_t>(width), -1);
  std::vector<int> back_cost(static_cast<std::size_t>(width), 64);
  std::vector<int> row(static_cast<std::size_t>(std::max(count, 0)));
  for (int x = first; x < width - kHalfX; ++x) {
    if (!left.textured(x, y)) continue;
    distances(right.bits.row(y).data() + first, left.bits(x, y), count, row.data());
    int best = 0;
    for (int i = 1; i < count; ++i)
      if (row[static_cast<std::size_t>(i)] < row[static_cast<std::size_t>(best)]) best = i;
    const int cost = row[static_cast<std::size_t>(best)];
    int second = 64;
    for (int i = 0; i < count; ++i) {
      if (std::abs(i - best) > 1) second = std::min(second, row[static_cast<std::size_t>(i)]);
      auto& known = back_cost[static_cast<std::size_t>(first + i)];
      if (row[static_cast<std::size_t>(i)] < known) {
        known = row[static_cast<std::size_t>(i)];
        back[static_cast<std::size_t>(first + i)] = x;
      }
    }
    if (second >= cost + 3) forth.best[static_cast<std::size_t>(x)] = first + best;
  }
}

/// The bins of the histogram (bin d + width holds coarse disparity d) that stand out from chance.
struct Standing {
  int low = 0;
  int high = 0;
  /// Matches from low to high beyond what chance gives there.
  double matches = 0.0;
};

std::optional<Standing> standing_out(const std::vector<int>& histogram, int width) {
  const int reach = 3 * width / 4;
  const auto at = [&](int d) { return histogram[static_cast<std::size_t>(d + width)]; };
  // Chance matches are as many as there are pairs of columns so far apart; most disparities see only chance.
  std::vector<double> per_column;
  double all = 0.0;
  for (int d = -reach; d <= reach; ++d) {
    per_column.push_back(at(d) / static_cast<double>(width - std::abs(d)));
    all += at(d);
  }
  std::nth_element(per_column.begin(), per_column.begin() + reach, per_column.end());
  const double chance = per_column[static_cast<std::size_t>(reach)];
  std::optional<Standing> found;
  for (int d = -reach + 1; d < reach; ++d) {
    const double three = at(d - 1) + at(d) + at(d + 1);
    const double by_chance = 3.0 * chance * (width - std::abs(d));
    if (at(d) == 0 || three < std::max({5.0, 0.002 * all, 5.0 * by_chance})) continue;
    if (!found) found = Standing{d, d, 0.0};
    found->high = d;
  }
  if (!found) return std::nullopt;
  for (int d = found->low; d <= found->high; ++d) found->matches += at(d) - chance * (width - std::abs(d));
  return found;
}

}  // namespace

DisparityRange find_disparity_range(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                    const Work& work) {
  const int factor = std::max(1, (left.width() + kCoarseWidth / 2) / kCoarseWidth);
  const Signatures l = signatures(shrunk(left, factor));
  const Signatures r = signatures(shrunk(right, factor));
  const int width = l.bits.width();
  const int height = l.bits.height();
  DisparityRange range{0, std::max(1, left.width() / 8), 0.0, 0.0};
  if (width <= 2 * kHalfX + 2 || height <= 2 * kHalfY) return range;

  Raster<int> histograms(2 * width + 1, height);  // a row of the picture each; the threads never share one
  std::vector<int> textured(static_cast<std::size_t>(height));
  parallel_for(work, height - 2 * kHalfY, 8, [&](int begin, int end) {
    RowMatches forth;
    std::vector<int> back;
    for (int y = begin + kHalfY; y < end + kHalfY; ++y) {
      if (work.cancelled()) return;
      match_row(l, r, y, forth, back);
      for (int x = kHalfX; x < width - kHalfX; ++x) {
        textured[static_cast<std::size_t>(y)] += l.textured(x, y);
        const int to = forth.best[static_cast<std::size_t>(x)];
        if (to >= 0 && std::abs(back[static_cast<std::size_t>(to)] - x) <= 1) ++histograms(x - to + width, y);
      }
    }
  });
  std::vector<int> histogram(static_cast<std::size_t>(2 * width + 1));
  int all_textured = 0;
  for (int y = 0; y < height; ++y) {
    all_textured += textured[static_cast<std::size_t>(y)];
    for (int i = 0; i <= 2 * width; ++i) histogram[static_cast<std::size_t>(i)] += histograms(i, y);
  }
  range.textured = static_cast<double>(all_textured) / (static_cast<double>(width) * height);
  const std::optional<Standing> standing = standing_out(histogram, width);
  if (!standing) return range;
  range.agreement = standing->matches / std::max(1, all_textured);
  // A margin for what the small copy could not resolve, and for surfaces too plain to be matched there.
  const int spread = standing->high - standing->low;
  const int low = (standing->low - 1) * factor - factor / 2 - spread * factor / 4;
  const bool all_in_front = standing->low >= -1;
  range.min_px = all_in_front ? std::max(0, low) : low;
  range.max_px = (standing->high + 1) * factor + factor / 2 + spread * factor / 16;
  range.max_px = std::clamp(range.max_px, range.min_px + 1, left.width() - 1);
  range.min_px = std::max(range.min_px, 1 - left.width());
  return range;
}

}  // namespace palpable::vision
