// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/background.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/segmentation/plane_mask.hpp"
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

/// Otsu's threshold: maximises the variance between two classes of disparities.
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

/// Whether a pixel is on the medial axis: its distance to the nearest unmarked pixel is a maximum along the
/// row or the column.
bool is_seed(const Raster<std::int32_t>& depth, int x, int y) {
  const int here = depth(x, y);
  if (here < 2) return false;
  const auto at = [&](int u, int v) { return depth.contains(u, v) ? depth(u, v) : 0; };
  return (here >= at(x - 1, y) && here >= at(x + 1, y)) || (here >= at(x, y - 1) && here >= at(x, y + 1));
}

/// Pixels of each region: with a known disparity, marked as near, on a medial axis.
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

/// How many of the largest candidates are background: the smallest number whose share of the candidates' area
/// exceeds the share of regions that remain.
std::size_t number_to_remove(const std::vector<double>& sizes_descending, int regions) {
  const double total = std::accumulate(sizes_descending.begin(), sizes_descending.end(), 0.0);
  double sum = 0.0;
  for (std::size_t n = 0; n < sizes_descending.size(); ++n) {
    sum += sizes_descending[n];
    if (sum >= (1.0 - static_cast<double>(n + 1) / regions) * total) return n + 1;
  }
  return sizes_descending.size();
}

/// Which regions are background, 1 or 0: those without seeds, or mostly far, of which the largest go.
std::vector<std::uint8_t> removed_regions(const Regions& regions, const Counts& counts,
                                          const BackgroundMaskOptions& options) {
  std::vector<std::size_t> candidates;
  for (std::size_t r = 0; r < counts.known.size(); ++r)
    if (counts.seeds[r] == 0.0 || counts.marked[r] < options.object_share * counts.known[r])
      candidates.push_back(r);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](std::size_t a, std::size_t b) { return regions.pixels[a] > regions.pixels[b]; });
  std::vector<double> sizes;
  sizes.reserve(candidates.size());
  for (const std::size_t r : candidates) sizes.push_back(static_cast<double>(regions.pixels[r]));
  candidates.resize(number_to_remove(sizes, regions.count()));
  std::vector<std::uint8_t> removed(counts.known.size());
  for (const std::size_t r : candidates) removed[r] = 1;
  return removed;
}

/// The paper's method, over known disparities.
std::optional<Background> background_regions(const Raster<Rgb8>& left, const Raster<float>& disparity_px,
                                             const Work& work, const BackgroundMaskOptions& options) {
  const Split split = otsu(disparity_px);
  if (split.range_px < options.least_range_px) return std::nullopt;
  Background out;
  out.by = Background::By::regions;
  out.threshold_px = split.threshold_px;
  Raster<std::uint8_t> marked(left.width(), left.height());
  for (std::size_t i = 0; i < marked.count(); ++i)
    marked.values()[i] = static_cast<double>(disparity_px.values()[i]) > split.threshold_px ? 1 : 0;
  const Regions regions = merge_regions(left, options.region_complexity);
  if (work.cancelled()) return std::nullopt;
  const auto removed = removed_regions(regions, counts_of(regions, disparity_px, marked), options);
  // A region of one colour may contain several surfaces, so pixels that are clearly near in a removed region
  // are kept, and clearly far ones in a kept region are removed.
  const double clearly_px = split.threshold_px + options.clear_share * split.range_px;
  out.mask = Raster<std::uint8_t>(left.width(), left.height());
  for (std::size_t i = 0; i < out.mask.count(); ++i) {
    const bool gone = removed[static_cast<std::size_t>(regions.of_pixel.values()[i])] != 0;
    const auto d = static_cast<double>(disparity_px.values()[i]);
    const bool behind = std::isfinite(d) ? d <= (gone ? clearly_px : split.threshold_px) : gone;
    out.mask.values()[i] = behind ? 255 : 0;
  }
  return out;
}

/// A plane that contains enough of the known disparities and has almost nothing behind it.
std::optional<Background> background_plane(const Raster<Rgb8>& left, const Raster<float>& disparity_px,
                                           const Work& work, const BackgroundMaskOptions& options) {
  const auto plane = find_back_plane(disparity_px, work, options.plane);
  if (!plane) return std::nullopt;
  const double tolerance_px = std::max(options.least_height_px, options.height_sigmas * plane->sigma_px);
  double known = 0.0, on = 0.0, behind = 0.0;
  for (int y = 0; y < disparity_px.height(); ++y)
    for (int x = 0; x < disparity_px.width(); ++x) {
      const double above = disparity_px(x, y) - plane->plane.at(x, y);
      if (!std::isfinite(above)) continue;
      known += 1.0;
      on += std::abs(above) <= tolerance_px ? 1.0 : 0.0;
      behind += above < -2.0 * tolerance_px ? 1.0 : 0.0;
    }
  if (on < options.least_plane_share * known || behind > options.most_behind_share * known)
    return std::nullopt;
  Background out;
  out.mask = plane_mask(merge_regions(left, options.region_complexity), disparity_px, *plane,
                        PlaneDirection::any, options.mask, work);
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(BackgroundMaskOptions& o) {
  std::vector<Parameter> all{
      {"least_height_px", &o.least_height_px, {0, 20}, "px", "least height of an object over the ground"},
      {"height_sigmas", &o.height_sigmas, {0, 20}, "", "the same in standard deviations of the ground"},
      {"step_px", &o.step_px, {0.05, 20}, "px", "greatest step within one surface"},
      {"least_object_share", &o.least_object_share, {0, 0.1}, "", "smallest object over the picture"},
      {"least_plane_share", &o.least_plane_share, {0, 1}, "", "share of pixels on a background plane"},
      {"most_behind_share", &o.most_behind_share, {0, 1}, "", "share of pixels behind it"},
      {"region_complexity", &o.region_complexity, {1, 1024}, "", "complexity of the colour regions"},
      {"least_range_px", &o.least_range_px, {0, 100}, "px", "least range of disparities"},
      {"object_share", &o.object_share, {0, 1}, "", "share of near pixels in an object's region"},
      {"clear_share",
       &o.clear_share,
       {0, 1},
       "",
       "distance from the threshold from which a pixel is an object"},
      {"least_share", &o.least_share, {0, 0.5}, "", "least share of the picture that is background"}};
  append_parameters(all, "plane", parameters_of(o.plane));
  append_parameters(all, "mask", parameters_of(o.mask));
  return all;
}

std::optional<Background> find_background(const Raster<Rgb8>& left, const Raster<float>& disparity_px,
                                          const Ground* ground, const Work& work,
                                          const BackgroundMaskOptions& options) {
  PALPABLE_CHECK(left.width() == disparity_px.width() && left.height() == disparity_px.height());
  Raster<float> rest = disparity_px;
  Raster<std::uint8_t> kept(left.width(), left.height());
  if (ground != nullptr) {
    kept = objects_on_ground(*ground, disparity_px, options);
    for (std::size_t i = 0; i < kept.count(); ++i) {
      kept.values()[i] |= ground->mask.values()[i];
      if (kept.values()[i] != 0) rest.values()[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  auto found = background_plane(left, rest, work, options);
  if (!found && !work.cancelled()) found = background_regions(left, rest, work, options);
  if (!found || work.cancelled()) return std::nullopt;
  for (std::size_t i = 0; i < kept.count(); ++i) {
    if (kept.values()[i] != 0) found->mask.values()[i] = 0;
    found->share += found->mask.values()[i] != 0 ? 1.0 : 0.0;
  }
  found->share /= static_cast<double>(kept.count());
  if (found->share < options.least_share || found->share > 1.0 - options.least_share) return std::nullopt;
  return found;
}

DisparityMap lowered(const DisparityMap& disparity, const Raster<std::uint8_t>& lower) {
  DisparityMap out = disparity;
  float farthest_px = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < lower.count(); ++i)
    if (lower.values()[i] == 0 && std::isfinite(disparity.disparity_px.values()[i]))
      farthest_px = std::min(farthest_px, disparity.disparity_px.values()[i]);
  if (!std::isfinite(farthest_px)) return out;
  for (std::size_t i = 0; i < lower.count(); ++i)
    if (lower.values()[i] != 0) out.disparity_px.values()[i] = farthest_px;
  return out;
}

}  // namespace palpable::vision
