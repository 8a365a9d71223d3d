// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/cross_window.hpp"
#include "palpable/vision/stereo/cost/sub_pixel.hpp"
#include "palpable/vision/stereo/methods/label_expansion.hpp"
#include "palpable/vision/stereo/occlusion/consistency.hpp"
#include "palpable/vision/stereo/problem/picture_pyramid.hpp"
#include "palpable/vision/stereo/problem/stereo_method.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

// Park & Howard 2012, equations 1-5 as docs/stereo.md corrects them.
namespace palpable::vision {
namespace {

// In units of the matching cost.
constexpr float kDataLimit = 60.0F;
constexpr float kTruncation_px = 2.0F;
constexpr float kSmoothness = 32.0F;
constexpr float kSmoothnessAcrossEdges = 3.0F;
constexpr float kEdgeLevels = 8.0F;
/// The data term is a mean over a window no larger than this, within alike colour: it quietens the noise of
/// single pixels and leaves the surfaces to the smoothness term.
constexpr CrossOptions kWindow{.row_reach_px = 3, .column_reach_px = 3, .sure_reach_px = 1};

/// Smoothness between two pixels: strong where they look alike.
float smoothness(Rgb8 a, Rgb8 b) {
  const int difference = std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
  return kSmoothnessAcrossEdges + (kSmoothness - kSmoothnessAcrossEdges) *
                                      std::exp(-static_cast<float>(difference) / (3.0F * kEdgeLevels));
}

void fill_smoothness(const Raster<Rgb8>& picture, GridEnergy& energy, const Work& work) {
  constexpr float kDiagonal = 0.70710678F;
  for (auto* weight : {&energy.right, &energy.down, &energy.down_right, &energy.down_left})
    *weight = Raster<float>(energy.width, energy.height);
  const auto between = [&](int x, int y, int u, int v) {
    return picture.contains(u, v) ? smoothness(picture(x, y), picture(u, v)) : 0.0F;
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

GridEnergy make_energy(const MatchInput& input, const Work& work) {
  GridEnergy energy;
  energy.width = input.left.width();
  energy.height = input.left.height();
  energy.labels = input.disparities;
  energy.truncation = kTruncation_px;
  fill_smoothness(input.left, energy, work);
  energy.data = aggregated_costs(input, kWindow, kDataLimit, work);
  return energy;
}

/// The cheapest label of each pixel, among those within `reach` of twice the coarse label where there is one.
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

/// In each cell: the labels that the coarse solution has near it, doubled, and one to each side; and those
/// that are the cheapest of several of its pixels, which brings back what the coarse picture could not
/// resolve.
Candidates candidates_from(const GridEnergy& energy, const Raster<int>& coarse) {
  constexpr int kCell = Candidates::kCell;
  constexpr int kBeside_px = 8;
  constexpr int kSeveral = 12;
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
        if (votes[static_cast<std::size_t>(d)] >= kSeveral) flags[d] = 1;
      const int right = std::min(coarse.width(), ((column + 1) * kCell + kBeside_px) / 2);
      const int bottom = std::min(coarse.height(), ((row + 1) * kCell + kBeside_px) / 2);
      for (int y = std::max(0, (row * kCell - kBeside_px) / 2); y < bottom; ++y)
        for (int x = std::max(0, (column * kCell - kBeside_px) / 2); x < right; ++x)
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

/// From coarse to fine: the smallest pictures try every label everywhere, the others those that came up
/// there.
Solution solve(const MatchInput& input, int level, const Work& work) {
  constexpr int kFewLabels = 10;
  constexpr int kFewPixels = 64;
  constexpr int kPasses = 2;
  Solution out{{}, make_energy(input, work)};
  const GridEnergy& energy = out.energy;
  if (work.cancelled()) return out;
  if (energy.labels <= kFewLabels || std::min(energy.width, energy.height) < kFewPixels) {
    Candidates all(energy.width, energy.height, energy.labels);
    std::fill(all.flags.begin(), all.flags.end(), std::uint8_t{1});
    out.label = cheapest(energy, {}, 0);
    expand_labels(energy, all, kPasses, out.label, work);
    return out;
  }
  const Raster<int> coarse = solve(halved(input), level + 1, work).label;
  if (work.cancelled()) return out;
  work.report(level == 0 ? 0.5 : 0.2, "cutting the graph");
  out.label = cheapest(energy, coarse, 1);
  expand_labels(energy, candidates_from(energy, coarse), kPasses, out.label, work);
  return out;
}

/// What a nearer surface covers in the right picture, or what it does not show, is hidden there: its
/// disparity is not to be trusted.
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

Result<MatchOutput> match_graph_cut(const MatchInput& input, const StereoOptions&, const Work& work) {
  const Solution solution = solve(input, 0, work);
  if (work.cancelled()) return Work::interrupted();
  const Raster<int>& label = solution.label;
  MatchOutput output{surface_through(label, work), {}};
  fill_from_behind(seen_by_both(label, input.right_first), output.disparity_px);
  return output;
}

}  // namespace palpable::vision
