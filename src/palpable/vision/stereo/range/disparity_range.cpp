// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/range/disparity_range.hpp"

#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/image/census.hpp"
#include "palpable/vision/stereo/cost/least_cost.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace palpable::vision {
namespace {

constexpr int kHalfX = kCensusHalfX;
constexpr int kHalfY = kCensusHalfY;
constexpr int kNoMatch = std::numeric_limits<int>::min();

PALPABLE_VECTORIZE void distances(const std::uint64_t* __restrict right, std::uint64_t left, int count,
                                  std::uint16_t* __restrict out) {
  for (int i = 0; i < count; ++i) out[i] = static_cast<std::uint16_t>(std::popcount(left ^ right[i]));
}

/// For one row: the best column in the other row for each textured column, or -1 if it is not unique; and the
/// best column here for each column there.
struct RowMatches {
  std::vector<int> forth;
  std::vector<std::uint8_t> textured;  // columns with enough texture to be matched
  std::vector<std::uint16_t> back, back_cost, distance;

  explicit RowMatches(int width)
      : forth(static_cast<std::size_t>(width)),
        textured(forth.size()),
        back(forth.size()),
        back_cost(forth.size()),
        distance(forth.size()) {}
};

void match_row(const Raster<std::uint64_t>& left, const Raster<std::uint64_t>& right, int y, int unique_bits,
               RowMatches& row) {
  constexpr std::uint16_t kUnlike = 64;
  constexpr std::uint16_t kNowhere = 65535;
  const int count = left.width() - 2 * kHalfX;
  std::fill(row.forth.begin(), row.forth.end(), -1);
  std::fill(row.back.begin(), row.back.end(), kNowhere);
  std::fill(row.back_cost.begin(), row.back_cost.end(), kUnlike);
  for (int x = kHalfX; x < kHalfX + count; ++x) {
    if (row.textured[static_cast<std::size_t>(x)] == 0) continue;
    distances(right.row(y).data() + kHalfX, left(x, y), count, row.distance.data());
    keep_least(row.distance.data(), static_cast<std::uint16_t>(x), count, row.back_cost.data() + kHalfX,
               row.back.data() + kHalfX);
    const LeastCost least = least_cost(row.distance.data(), count);
    if (least.elsewhere >= least.cost + unique_bits)
      row.forth[static_cast<std::size_t>(x)] = kHalfX + least.at;
  }
}

/// The bins of the histogram (bin d + width holds coarse disparity d) that exceed chance.
struct OccupiedBins {
  int low = 0;
  int high = 0;
  double matches = 0.0;
};

/// The range, grown from the histogram's peak.
std::optional<OccupiedBins> occupied_bins(const std::vector<int>& histogram, const RangeOptions& options,
                                          int width) {
  const auto three = [&](int d) {
    double sum = 0.0;
    for (int k = std::max(-width, d - 1); k <= std::min(width, d + 1); ++k)
      sum += histogram[static_cast<std::size_t>(k + width)];
    return sum;
  };
  const double all = std::accumulate(histogram.begin(), histogram.end(), 0.0);
  const int peak =
      static_cast<int>(std::max_element(histogram.begin(), histogram.end()) - histogram.begin()) - width;
  if (three(peak) < 10.0) return std::nullopt;
  OccupiedBins found{peak, peak, 0.0};
  const bool peak_in_front = peak >= 0;
  const auto grow = [&](int& end, int direction) {
    for (int d = peak; std::abs(d) <= 3 * width / 4; d += direction) {
      const bool other_side = peak_in_front ? d < -1 : d > 1;
      const double share = other_side                             ? options.share_behind_infinity
                           : std::abs(d - end) > options.gap_bins ? options.share_beyond_gap
                                                                  : options.share;
      if (histogram[static_cast<std::size_t>(d + width)] > 0 && three(d) >= std::max(5.0, share * all))
        end = d;
    }
  };
  grow(found.low, -1);
  grow(found.high, +1);
  for (int d = found.low; d <= found.high; ++d)
    found.matches += histogram[static_cast<std::size_t>(d + width)];
  return found;
}

/// Whether enough neighbours, in the row and in the adjacent rows, confirm a match within one pixel.
bool confirmed(const Raster<int>& matches, int least, int x, int y) {
  const int d = matches(x, y);
  int agreeing = 0;
  for (int v = std::max(0, y - 1); v <= std::min(matches.height() - 1, y + 1); ++v)
    for (int u = std::max(0, x - 2); u <= std::min(matches.width() - 1, x + 2); ++u)
      if (matches(u, v) != kNoMatch && std::abs(matches(u, v) - d) <= 1) ++agreeing;
  return agreeing >= least;
}

/// The greatest disparity of a plain surface, within a pixel, that covers enough of the picture; 0 if there
/// is none.
int nearest_plain_px(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                     const RangeOptions& options, const Work& work) {
  const std::vector<int> pixels = plain_run_disparities(left, right, options.plain, work);
  const double enough = options.plain_share * static_cast<double>(left.count());
  for (int d = left.width() - 2; d > 0; --d) {
    const auto k = static_cast<std::size_t>(d);
    if (pixels[k - 1] + pixels[k] + pixels[k + 1] >= enough) return d;
  }
  return 0;
}

}  // namespace

std::vector<Parameter> parameters_of(RangeOptions& o) {
  std::vector<Parameter> all{
      {"coarse_width_px", &o.coarse_width_px, {32, 2048}, "px", "Width of the reduced pair"},
      {"rows", &o.rows, {8, 2048}, "", "Rows of it that are matched"},
      {"unique_bits", &o.unique_bits, {0, 63}, "bits", "Least margin to the next best match"},
      {"agreeing_neighbours",
       &o.agreeing_neighbours,
       {1, 15},
       "",
       "Neighbours that must agree, itself included"},
      {"share", &o.share, {0, 1}, "", "Share of the matches in a bin of the range"},
      {"gap_bins", &o.gap_bins, {0, 100}, "bins", "Bins beyond a longer gap need a larger share"},
      {"share_beyond_gap", &o.share_beyond_gap, {0, 1}, "", "The share beyond a gap"},
      {"share_behind_infinity", &o.share_behind_infinity, {0, 1}, "", "The share behind infinity"},
      {"far_margin_divisor", &o.far_margin_divisor, {1, 1000}, "", "The far margin: the range over this"},
      {"enough_texture",
       &o.enough_texture,
       {0.01, 1},
       "",
       "Textured share below which the far end moves to 0"},
      {"near_margin_divisor", &o.near_margin_divisor, {1, 1000}, "", "The near margin: the range over this"},
      {"plain_share", &o.plain_share, {0, 1}, "", "Share of a plain surface that moves the near end"}};
  append_parameters(all, "plain", parameters_of(o.plain));
  return all;
}

DisparityRange find_disparity_range(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                    const RangeOptions& options, const Work& work) {
  const int factor = std::max(1, (left.width() + options.coarse_width_px / 2) / options.coarse_width_px);
  const Raster<std::uint8_t> small = shrunk(left, factor);
  const Raster<std::uint64_t> l = census_9x7(small, work);
  const Raster<std::uint64_t> r = census_9x7(shrunk(right, factor), work);
  const int width = l.width();
  const int height = l.height();
  DisparityRange range{0, std::max(1, left.width() / 8), 0.0, 0.0};
  if (width <= 2 * kHalfX + 2 || height <= 2 * kHalfY) return range;

  const int step = std::max(1, (height - 2 * kHalfY) / options.rows);
  const int rows = (height - 2 * kHalfY + step - 1) / step;
  Raster<int> matches(width, rows, kNoMatch);
  std::vector<int> textured(static_cast<std::size_t>(rows));
  parallel_for(work, rows, 8, [&](int begin, int end) {
    RowMatches row(width);
    for (int i = begin; i < end; ++i) {
      if (work.cancelled()) return;
      const int y = kHalfY + step * i;
      for (int x = 0; x < width; ++x)
        textured[static_cast<std::size_t>(i)] += row.textured[static_cast<std::size_t>(x)] =
            has_texture(small, x, y) ? 1 : 0;
      match_row(l, r, y, options.unique_bits, row);
      for (int x = kHalfX; x < width - kHalfX; ++x) {
        const int to = row.forth[static_cast<std::size_t>(x)];
        if (to >= 0 && std::abs(row.back[static_cast<std::size_t>(to)] - x) <= 1) matches(x, i) = x - to;
      }
    }
  });
  std::vector<int> histogram(static_cast<std::size_t>(2 * width + 1));
  const int all_textured = std::accumulate(textured.begin(), textured.end(), 0);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < width; ++x)
      if (matches(x, y) != kNoMatch && confirmed(matches, options.agreeing_neighbours, x, y))
        ++histogram[static_cast<std::size_t>(matches(x, y) + width)];
  range.textured = static_cast<double>(all_textured) / (static_cast<double>(width) * rows);
  const std::optional<OccupiedBins> bins = occupied_bins(histogram, options, width);
  if (!bins) return range;
  range.agreement = bins->matches / std::max(1, all_textured);
  // A margin for the reduced pair's resolution, and for surfaces too plain to be matched in it.
  const int spread = bins->high - bins->low;
  const int low = (bins->low - 1) * factor - factor / 2 - spread * factor / options.far_margin_divisor;
  const bool all_in_front = bins->low >= -1;
  // What has no texture was not matched at all, and may be farther than everything that was.
  const double matched = std::min(1.0, range.textured / options.enough_texture);
  range.min_px = all_in_front ? static_cast<int>(std::max(0, low) * matched) : low;
  range.max_px = (bins->high + 1) * factor + factor / 2 + spread * factor / options.near_margin_divisor;
  if (all_in_front)
    if (const int plain_px = nearest_plain_px(left, right, options, work); plain_px > range.max_px)
      range.max_px = plain_px + 2;
  range.max_px = std::clamp(range.max_px, range.min_px + 1, left.width() - 1);
  range.min_px = std::max(range.min_px, 1 - left.width());
  return range;
}

}  // namespace palpable::vision
