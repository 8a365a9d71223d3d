// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/background.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/quantile.hpp"
#include "palpable/vision/segmentation/regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace palpable::vision {
namespace {

struct Split {
  double threshold_px = 0.0;
  double range_px = 0.0;
};

/// Otsu's threshold: between the two classes of disparities whose means differ most for their shares.
Split otsu(const Raster<float>& disparity_px) {
  constexpr int kBins = 256;
  std::vector<float> known;
  for (const float d : disparity_px.values())
    if (std::isfinite(d)) known.push_back(d);
  if (known.empty()) return {};
  const double low{quantile_of(known, 0.01)}, range = double{quantile_of(known, 0.99)} - low;
  if (!(range > 0.0)) return {low, 0.0};
  std::array<double, kBins> counts{};
  for (const float d : known)
    counts[static_cast<std::size_t>(std::clamp((d - low) / range, 0.0, 1.0) * (kBins - 1))] += 1.0;
  const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
  double sum_all = 0.0;
  for (int k = 0; k < kBins; ++k) sum_all += k * counts[static_cast<std::size_t>(k)];
  double below = 0.0, sum = 0.0, most = -1.0;
  int best = 0;
  for (int k = 0; k + 1 < kBins; ++k) {
    below += counts[static_cast<std::size_t>(k)];
    sum += k * counts[static_cast<std::size_t>(k)];
    if (below == 0.0 || below == all) continue;
    const double apart = sum / below - (sum_all - sum) / (all - below);
    const double between = below * (all - below) * apart * apart;
    if (between > most) {
      most = between;
      best = k;
    }
  }
  return {low + range * (best + 0.5) / (kBins - 1), range};
}

/// City-block distance of each marked pixel to the nearest unmarked one; the picture's edge counts as marked.
Raster<std::int32_t> depth_inside(const Raster<std::uint8_t>& marked) {
  const int width = marked.width(), height = marked.height(), far = width + height;
  Raster<std::int32_t> out(width, height);
  const auto at = [&](int x, int y) { return out.contains(x, y) ? out(x, y) : far; };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out(x, y) = marked(x, y) == 0 ? 0 : std::min(far, 1 + std::min(at(x - 1, y), at(x, y - 1)));
  for (int y = height - 1; y >= 0; --y)
    for (int x = width - 1; x >= 0; --x)
      out(x, y) = std::min(out(x, y), 1 + std::min(at(x + 1, y), at(x, y + 1)));
  return out;
}

/// The middle lines of what is marked: nowhere among its neighbours is it deeper inside along the row, or
/// along the column.
bool is_seed(const Raster<std::int32_t>& depth, int x, int y) {
  const int here = depth(x, y);
  if (here < 2) return false;
  const auto at = [&](int u, int v) { return depth.contains(u, v) ? depth(u, v) : 0; };
  return (here >= at(x - 1, y) && here >= at(x + 1, y)) || (here >= at(x, y - 1) && here >= at(x, y + 1));
}

/// What is known of each region.
struct Counts {
  std::vector<double> known, marked, seeds;
};

Counts counts_of(const Regions& regions, const Raster<float>& disparity_px,
                 const Raster<std::uint8_t>& marked) {
  const auto n = static_cast<std::size_t>(regions.count());
  Counts out{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  const Raster<std::int32_t> depth = depth_inside(marked);
  for (int y = 0; y < marked.height(); ++y)
    for (int x = 0; x < marked.width(); ++x) {
      const auto region = static_cast<std::size_t>(regions.of_pixel(x, y));
      out.known[region] += std::isfinite(disparity_px(x, y)) ? 1.0 : 0.0;
      out.marked[region] += marked(x, y) != 0 ? 1.0 : 0.0;
      out.seeds[region] += is_seed(depth, x, y) ? 1.0 : 0.0;
    }
  return out;
}

/// How many of the largest candidates are background: the fewest that hold a greater share of the candidates'
/// area than the share of all regions that is left over. Few large ones go early; many of a size are looked
/// at singly.
std::size_t number_to_remove(const std::vector<double>& sizes_descending, int regions) {
  const double total = std::accumulate(sizes_descending.begin(), sizes_descending.end(), 0.0);
  double sum = 0.0;
  for (std::size_t n = 0; n < sizes_descending.size(); ++n) {
    sum += sizes_descending[n];
    if (sum >= (1.0 - static_cast<double>(n + 1) / regions) * total) return n + 1;
  }
  return sizes_descending.size();
}

}  // namespace

std::optional<Background> find_background(const Raster<Rgb8>& left, const Raster<float>& disparity_px,
                                          const Work& work) {
  PALPABLE_CHECK(left.width() == disparity_px.width() && left.height() == disparity_px.height());
  constexpr double kLeastRange_px = 2.0, kMostlyThing = 0.5, kLeastShare = 0.01;
  const Split split = otsu(disparity_px);
  if (split.range_px < kLeastRange_px) return std::nullopt;
  Background out;
  out.threshold_px = split.threshold_px;
  Raster<std::uint8_t> marked(left.width(), left.height());
  for (std::size_t i = 0; i < marked.count(); ++i)
    marked.values()[i] = static_cast<double>(disparity_px.values()[i]) > split.threshold_px ? 1 : 0;
  const Regions regions = merge_regions(left);
  if (work.cancelled()) return std::nullopt;
  const Counts counts = counts_of(regions, disparity_px, marked);
  out.regions = regions.count();

  std::vector<std::size_t> candidates;
  for (std::size_t r = 0; r < counts.known.size(); ++r)
    if (counts.seeds[r] == 0.0 || counts.marked[r] < kMostlyThing * counts.known[r]) candidates.push_back(r);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](std::size_t a, std::size_t b) { return regions.pixels[a] > regions.pixels[b]; });
  std::vector<double> sizes;
  sizes.reserve(candidates.size());
  for (const std::size_t r : candidates) sizes.push_back(static_cast<double>(regions.pixels[r]));
  candidates.resize(number_to_remove(sizes, out.regions));
  out.removed = static_cast<int>(candidates.size());
  std::vector<std::uint8_t> removed(counts.known.size());
  for (const std::size_t r : candidates) removed[r] = 1;

  // A region is of one colour, not of one thing: what clearly moves in a removed one is none of the
  // background, and what hardly moves in a kept one is.
  const double clearly_px = split.threshold_px + 0.1 * split.range_px;
  out.mask = Raster<std::uint8_t>(left.width(), left.height());
  for (int y = 0; y < out.mask.height(); ++y)
    for (int x = 0; x < out.mask.width(); ++x) {
      const bool gone = removed[static_cast<std::size_t>(regions.of_pixel(x, y))] != 0;
      const auto d = static_cast<double>(disparity_px(x, y));
      const bool behind = std::isfinite(d) ? d <= (gone ? clearly_px : split.threshold_px) : gone;
      out.mask(x, y) = behind ? 255 : 0;
      out.share += behind ? 1.0 : 0.0;
    }
  out.share /= static_cast<double>(out.mask.count());
  if (out.share < kLeastShare || out.share > 1.0 - kLeastShare) return std::nullopt;
  return out;
}

DisparityMap lowered(const DisparityMap& disparity, const Raster<std::uint8_t>& goes) {
  DisparityMap out = disparity;
  float farthest_px = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < goes.count(); ++i)
    if (goes.values()[i] == 0 && std::isfinite(disparity.disparity_px.values()[i]))
      farthest_px = std::min(farthest_px, disparity.disparity_px.values()[i]);
  if (!std::isfinite(farthest_px)) return out;
  for (std::size_t i = 0; i < goes.count(); ++i)
    if (goes.values()[i] != 0) out.disparity_px.values()[i] = farthest_px;
  return out;
}

}  // namespace palpable::vision
