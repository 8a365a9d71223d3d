// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/sgm.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <cmath>

namespace palpable::vision {
namespace {

/// The guard cost before the first and after the last disparity: above every path cost plus a penalty.
constexpr std::uint16_t kGuardCost = 40000;
constexpr int kGuard = 32;
/// The sum of four path costs, each at most a matching cost and a large step, fits 16 bits.
constexpr int kLargestPenalty = 5;
static_assert(4 * (2 + kLargestPenalty) * kCostUnit <= 65535);

struct Penalties {
  std::uint16_t small_plain, large_plain, small_edge, large_edge;
};

/// The penalties without and with an edge in the reference picture.
struct PenaltyTable {
  Penalties plain, edge;

  explicit PenaltyTable(const SgmOptions& options) {
    const auto share = [](float units, int divisor) {
      return static_cast<std::uint16_t>(static_cast<int>(std::lround(units * kCostUnit)) / divisor);
    };
    const int one = options.one_edge_divisor;
    const int both = options.both_edges_divisor;
    plain = {share(options.small_step, 1), share(options.large_step, 1), share(options.small_step, one),
             share(options.large_step, one)};
    edge = {share(options.small_step, one), share(options.large_step, one), share(options.small_step, both),
            share(options.large_step, both)};
  }
};

/// One pixel of one path. `before` and `path` have a guard value on each side; returns the path's least cost.
/// other_edge[d] is all ones where the other picture has an edge there.
PALPABLE_VECTORIZE
std::uint16_t step(const std::uint16_t* __restrict cost, const std::uint16_t* __restrict before,
                   std::uint16_t least_before, const std::uint16_t* __restrict other_edge, Penalties p,
                   int count, std::uint16_t* __restrict path, std::uint16_t* __restrict sum) {
  std::uint16_t least = 65535;
  for (int d = 0; d < count; ++d) {
    const std::uint16_t small = other_edge[d] ? p.small_edge : p.small_plain;
    const std::uint16_t large = other_edge[d] ? p.large_edge : p.large_plain;
    const auto jump = static_cast<std::uint16_t>(least_before + large);
    const std::uint16_t beside = before[d - 1] < before[d + 1] ? before[d - 1] : before[d + 1];
    const auto shift = static_cast<std::uint16_t>(beside + small);
    std::uint16_t best = before[d] < jump ? before[d] : jump;
    best = shift < best ? shift : best;
    const auto value = static_cast<std::uint16_t>(cost[d] + best - least_before);
    path[d] = value;
    sum[d] = static_cast<std::uint16_t>(sum[d] + value);
    least = value < least ? value : least;
  }
  return least;
}

PALPABLE_VECTORIZE
std::uint16_t begin_path(const std::uint16_t* __restrict cost, int count, std::uint16_t* __restrict path,
                         std::uint16_t* __restrict sum) {
  std::uint16_t least = 65535;
  for (int d = 0; d < count; ++d) {
    path[d] = cost[d];
    sum[d] = static_cast<std::uint16_t>(sum[d] + cost[d]);
    least = cost[d] < least ? cost[d] : least;
  }
  return least;
}

/// 1 at (x, y) where the colour changes from the pixel at (x - dx, y - dy).
Raster<std::uint8_t> edges(const ColourPlanes& colour, int levels, int dx, int dy) {
  Raster<std::uint8_t> out(colour.width(), colour.height());
  for (int y = dy; y < out.height(); ++y)
    for (int x = dx; x < out.width(); ++x)
      out(x, y) = colour.difference(x, y, x - dx, y - dy) >= levels ? 1 : 0;
  return out;
}

/// The row's edges from right to left as masks, so that the index increases with d; zeros beyond its end.
void reversed_masks(const Raster<std::uint8_t>& edge, int y, std::vector<std::uint16_t>& out) {
  const auto row = edge.row(y);
  for (std::size_t x = 0; x < row.size(); ++x) out[row.size() - 1 - x] = row[x] != 0 ? 65535 : 0;
}

/// The state of one path: the costs of the last pixel and of this one, each between guards.
class Path {
 public:
  explicit Path(int stride)
      : before_(static_cast<std::size_t>(stride + 2 * kGuard), kGuardCost), path_(before_) {}
  void begin(const std::uint16_t* cost, int count, std::uint16_t* sum) {
    least_ = begin_path(cost, count, before_.data() + kGuard, sum);
  }
  void advance(const std::uint16_t* cost, const std::uint16_t* other_edge, Penalties penalties, int count,
               std::uint16_t* sum) {
    least_ =
        step(cost, before_.data() + kGuard, least_, other_edge, penalties, count, path_.data() + kGuard, sum);
    before_.swap(path_);
  }

 private:
  std::vector<std::uint16_t> before_;
  std::vector<std::uint16_t> path_;
  std::uint16_t least_ = 0;
};

void aggregate_rows(const CostVolume& costs, const ColourPlanes& reference, const ColourPlanes& other,
                    const SgmOptions& options, CostVolume& sums, const Work& work) {
  const PenaltyTable penalties(options);
  const Raster<std::uint8_t> here = edges(reference, options.edge_levels, 1, 0);
  const Raster<std::uint8_t> there = edges(other, options.edge_levels, 1, 0);
  const int w = costs.width;
  parallel_for(work, costs.height, 2, [&](int begin, int end) {
    Path path(costs.stride);
    std::vector<std::uint16_t> mask(static_cast<std::size_t>(w + costs.stride + 1));
    for (int y = begin; y < end; ++y) {
      reversed_masks(there, y, mask);
      path.begin(costs.at(0, y), costs.disparities, sums.at(0, y));
      for (int x = 1; x < w; ++x)
        path.advance(costs.at(x, y), mask.data() + (w - 1 - x),
                     here(x, y) != 0 ? penalties.edge : penalties.plain, costs.disparities, sums.at(x, y));
      path.begin(costs.at(w - 1, y), costs.disparities, sums.at(w - 1, y));
      for (int x = w - 2; x >= 0; --x)
        path.advance(costs.at(x, y), mask.data() + (w - 2 - x),
                     here(x + 1, y) != 0 ? penalties.edge : penalties.plain, costs.disparities,
                     sums.at(x, y));
    }
  });
}

void aggregate_columns(const CostVolume& costs, const ColourPlanes& reference, const ColourPlanes& other,
                       const SgmOptions& options, CostVolume& sums, const Work& work) {
  const PenaltyTable penalties(options);
  const Raster<std::uint8_t> here = edges(reference, options.edge_levels, 0, 1);
  const Raster<std::uint8_t> there = edges(other, options.edge_levels, 0, 1);
  const int w = costs.width;
  const int h = costs.height;
  parallel_for(work, w, 16, [&](int begin, int end) {
    std::vector<std::uint16_t> mask(static_cast<std::size_t>(w + costs.stride + 1));
    for (int way = 0; way < 2; ++way) {
      std::vector<Path> paths(static_cast<std::size_t>(end - begin), Path(costs.stride));
      for (int n = 0; n < h; ++n) {
        const int y = way == 0 ? n : h - 1 - n;
        const int edge_row = way == 0 ? y : y + 1;
        if (n > 0) reversed_masks(there, edge_row, mask);
        for (int x = begin; x < end; ++x) {
          Path& path = paths[static_cast<std::size_t>(x - begin)];
          if (n == 0)
            path.begin(costs.at(x, y), costs.disparities, sums.at(x, y));
          else
            path.advance(costs.at(x, y), mask.data() + (w - 1 - x),
                         here(x, edge_row) != 0 ? penalties.edge : penalties.plain, costs.disparities,
                         sums.at(x, y));
        }
      }
    }
  });
}

}  // namespace

std::vector<Parameter> parameters_of(SgmOptions& o) {
  return {
      {"small_step", &o.small_step, {0, kLargestPenalty}, "units", "Penalty for a step of one disparity"},
      {"large_step", &o.large_step, {0, kLargestPenalty}, "units", "Penalty for a larger step"},
      {"edge_levels", &o.edge_levels, {1, 255}, "levels", "Colour difference that is an edge"},
      {"one_edge_divisor", &o.one_edge_divisor, {1, 100}, "", "Divides penalties if one picture has an edge"},
      {"both_edges_divisor", &o.both_edges_divisor, {1, 100}, "", "Divides penalties if both have one"}};
}

void aggregate_paths(const CostVolume& costs, const ColourPlanes& reference, const ColourPlanes& other,
                     const SgmOptions& options, CostVolume& sums, const Work& work) {
  std::fill(sums.cost.begin(), sums.cost.end(), std::uint16_t{0});
  aggregate_rows(costs, reference, other, options, sums, work);
  aggregate_columns(costs, reference, other, options, sums, work);
}

Raster<float> least_cost_disparity(const CostVolume& costs, const Work& work) {
  Raster<float> out(costs.width, costs.height);
  parallel_for(work, costs.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < costs.width; ++x) {
        const std::uint16_t* cost = costs.at(x, y);
        const int d = static_cast<int>(std::min_element(cost, cost + costs.disparities) - cost);
        out(x, y) = static_cast<float>(d);
        if (d == 0 || d + 1 == costs.disparities) continue;
        const int bend = cost[d - 1] + cost[d + 1] - 2 * cost[d];
        if (bend > 0)
          out(x, y) += static_cast<float>(cost[d - 1] - cost[d + 1]) / (2.0F * static_cast<float>(bend));
      }
  });
  return out;
}

}  // namespace palpable::vision
