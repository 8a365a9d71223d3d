// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/graph_cut.hpp"

#include "palpable/vision/stereo/cost/sub_pixel.hpp"
#include "palpable/vision/stereo/methods/label_expansion.hpp"
#include "palpable/vision/stereo/occlusion/filling.hpp"
#include "palpable/vision/stereo/problem/picture_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

// Park & Howard 2012, equations 1-5 as docs/stereo.md corrects them.
namespace palpable::vision {
namespace {

/// Smoothness between two pixels: strong where their colours are similar.
float smoothness(const GraphCutOptions& options, Rgb8 a, Rgb8 b) {
  const int difference = std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
  return options.edge_smoothness +
         (options.smoothness - options.edge_smoothness) *
             std::exp(-static_cast<float>(difference) / (3.0F * options.edge_levels));
}

void fill_smoothness(const Raster<Rgb8>& picture, const GraphCutOptions& options, GridEnergy& energy,
                     const Work& work) {
  constexpr float kDiagonal = 0.70710678F;
  for (auto* weight : {&energy.right, &energy.down, &energy.down_right, &energy.down_left})
    *weight = Raster<float>(energy.width, energy.height);
  const auto between = [&](int x, int y, int u, int v) {
    return picture.contains(u, v) ? smoothness(options, picture(x, y), picture(u, v)) : 0.0F;
  };
  parallel_for(work, energy.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < energy.width; ++x) {
        energy.right(x, y) = between(x, y, x + 1, y);
        energy.down(x, y) = between(x, y, x, y + 1);
        energy.down_right(x, y) = kDiagonal * between(x, y, x + 1, y + 1);
        energy.down_left(x, y) = kDiagonal * between(x, y, x - 1, y + 1);
      }
    }
  });
}

GridEnergy make_energy(const MatchInput& input, const GraphCutOptions& options, const Work& work) {
  GridEnergy energy;
  energy.width = input.left.width();
  energy.height = input.left.height();
  energy.labels = input.disparities;
  energy.truncation = options.truncation_px;
  fill_smoothness(input.left, options, energy, work);
  energy.data = aggregated_costs(input, options.data, work);
  return energy;
}

/// The label of least cost at each pixel, within `reach` of twice the coarse label if there is one.
Raster<int> cheapest(const GridEnergy& energy, const Raster<int>& coarse, int reach) {
  Raster<int> label(energy.width, energy.height);
  for (int y = 0; y < energy.height; ++y) {
    for (int x = 0; x < energy.width; ++x) {
      const std::uint8_t* costs = energy.costs(x, y);
      const int middle = coarse.empty() ? 0 : std::min(2 * coarse(x / 2, y / 2), energy.labels - 1);
      const int first = coarse.empty() ? 0 : std::max(0, middle - reach);
      const int last = coarse.empty() ? energy.labels : std::min(energy.labels, middle + reach + 1);
      int best = middle;
      for (int d = first; d < last; ++d)
        if (costs[d] < costs[best]) best = d;
      label(x, y) = best;
    }
  }
  return label;
}

/// The candidates of each cell: the doubled labels of the coarse solution near it with their neighbours, and
/// labels of least cost at several of its pixels.
Candidates candidates_from(const GridEnergy& energy, const GraphCutOptions& options,
                           const Raster<int>& coarse) {
  constexpr int kCell = Candidates::kCell;
  const int reach = options.candidate_reach_px;
  const Raster<int> cheap = cheapest(energy, {}, 0);
  Candidates out(energy.width, energy.height, energy.labels);
  std::vector<int> votes(static_cast<std::size_t>(energy.labels));
  for (int row = 0; row < out.rows; ++row) {
    for (int column = 0; column < out.columns; ++column) {
      std::uint8_t* flags = out.of(column, row);
      std::fill(votes.begin(), votes.end(), 0);
      for (int y = row * kCell; y < std::min(energy.height, (row + 1) * kCell); ++y)
        for (int x = column * kCell; x < std::min(energy.width, (column + 1) * kCell); ++x)
          ++votes[static_cast<std::size_t>(cheap(x, y))];
      for (int d = 0; d < energy.labels; ++d)
        if (votes[static_cast<std::size_t>(d)] >= options.candidate_pixels) flags[d] = 1;
      const int right = std::min(coarse.width(), ((column + 1) * kCell + reach) / 2);
      const int bottom = std::min(coarse.height(), ((row + 1) * kCell + reach) / 2);
      for (int y = std::max(0, (row * kCell - reach) / 2); y < bottom; ++y)
        for (int x = std::max(0, (column * kCell - reach) / 2); x < right; ++x)
          for (int d = std::max(0, 2 * coarse(x, y) - 1);
               d <= std::min(energy.labels - 1, 2 * coarse(x, y) + 1); ++d)
            flags[d] = 1;
    }
  }
  return out;
}

struct Solution {
  Raster<int> label;
  GridEnergy energy;
};

/// From coarse to fine: the smallest pictures try all labels everywhere, the others only the candidates.
Solution solve(const MatchInput& input, const GraphCutOptions& options, int level, const Work& work) {
  Solution out{{}, make_energy(input, options, work)};
  const GridEnergy& energy = out.energy;
  if (work.cancelled()) return out;
  if (energy.labels <= options.few_disparities ||
      std::min(energy.width, energy.height) < options.few_pixels) {
    Candidates all(energy.width, energy.height, energy.labels);
    std::fill(all.flags.begin(), all.flags.end(), std::uint8_t{1});
    out.label = cheapest(energy, {}, 0);
    expand_labels(energy, all, options.passes, out.label, work);
    return out;
  }
  const Raster<int> coarse = solve(halved(input), options, level + 1, work).label;
  if (work.cancelled()) return out;
  work.report(level == 0 ? 0.5 : 0.2, "cutting the graph");
  out.label = cheapest(energy, coarse, 1);
  expand_labels(energy, candidates_from(energy, options, coarse), options.passes, out.label, work);
  return out;
}

/// 0 if a nearer surface occludes the pixel in the right picture, or it is outside that picture.
Raster<std::uint8_t> seen_by_both(const Raster<int>& label, int right_first) {
  Raster<std::uint8_t> seen(label.width(), label.height());
  std::vector<int> nearest(static_cast<std::size_t>(label.width()));
  for (int y = 0; y < label.height(); ++y) {
    std::fill(nearest.begin(), nearest.end(), -1);
    for (int x = 0; x < label.width(); ++x) {
      if (x < label(x, y) + right_first) continue;
      int& there = nearest[static_cast<std::size_t>(x - label(x, y))];
      there = std::max(there, label(x, y));
    }
    for (int x = 0; x < label.width(); ++x)
      seen(x, y) = x >= label(x, y) + right_first &&
                   nearest[static_cast<std::size_t>(x - label(x, y))] <= label(x, y) + 1;
  }
  return seen;
}

}  // namespace

std::vector<Parameter> parameters_of(GraphCutOptions& o) {
  std::vector<Parameter> all{
      {"smoothness", &o.smoothness, {0, 500}, "cost", "Smoothness of neighbours of one colour"},
      {"edge_smoothness", &o.edge_smoothness, {0, 500}, "cost", "Smoothness across the strongest edge"},
      {"edge_levels", &o.edge_levels, {0.1, 255}, "levels", "Colour difference at which it falls by e"},
      {"truncation_px", &o.truncation_px, {1, 100}, "px", "Disparities that differ by more cost no more"},
      {"few_disparities", &o.few_disparities, {2, 1000}, "", "Up to this many are all tried everywhere"},
      {"few_pixels",
       &o.few_pixels,
       {8, 10000},
       "px",
       "A short side below which all labels are tried everywhere"},
      {"passes", &o.passes, {1, 20}, "", "Expansion moves over all labels"},
      {"candidate_reach_px", &o.candidate_reach_px, {0, 100}, "px", "Reach of the coarser solution's labels"},
      {"candidate_pixels",
       &o.candidate_pixels,
       {1, 256},
       "px",
       "Pixels of a cell that make their cheapest label one"},
      {"membrane_iterations", &o.membrane_iterations, {0, 1000}, "", "Iterations of the membrane"}};
  append_parameters(all, "data", parameters_of(o.data));
  return all;
}

Result<void> check(const GraphCutOptions& options) {
  if (auto ok = check_ranges(options); !ok) return ok;
  return check_window_size(options.data.window);
}

Result<MatchOutput> match_graph_cut(const MatchInput& input, const GraphCutOptions& options,
                                    const Work& work) {
  if (const auto ok = check(options); !ok) return ok.error();
  const Solution solution = solve(input, options, 0, work);
  if (work.cancelled()) return Work::interrupted();
  const Raster<int>& label = solution.label;
  MatchOutput output{membrane_through(label, options.membrane_iterations, work), {}};
  fill_from_background(seen_by_both(label, input.right_first), output.disparity_px);
  return output;
}

}  // namespace palpable::vision
