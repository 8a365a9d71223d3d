// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/path_costs.hpp"

#include "palpable/vision/stereo/cost/least_cost.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 12;
constexpr int kStride = 32;
constexpr int kSmallStepShare = 70;

/// Hirschmueller's eq. 13 along one path, minus the minimum of each pixel.
std::vector<int> path_by_definition(const std::vector<std::uint8_t>& cost,
                                    const std::vector<std::uint8_t>& steps, int small_share_of_256) {
  std::vector<int> path(cost.size());
  for (int x = 0; x < kWidth; ++x) {
    const auto at = [&](int u, int d) { return static_cast<std::size_t>(u * kStride + d); };
    const int large = steps[static_cast<std::size_t>(x)];
    const int small = large * small_share_of_256 / 256;
    for (int d = 0; d < kStride; ++d) {
      int best = x == 0 ? 0 : large;
      if (x > 0) {
        best = std::min(best, path[at(x - 1, d)]);
        if (d > 0) best = std::min(best, path[at(x - 1, d - 1)] + small);
        if (d + 1 < kStride) best = std::min(best, path[at(x - 1, d + 1)] + small);
      }
      path[at(x, d)] = cost[at(x, d)] + best;
    }
    const auto first = path.begin() + x * kStride;
    const int least = *std::min_element(first, first + kStride);
    for (int d = 0; d < kStride; ++d) path[at(x, d)] -= least;
  }
  return path;
}

std::vector<std::uint8_t> some_costs() {
  std::vector<std::uint8_t> cost(static_cast<std::size_t>(kWidth * kStride));
  unsigned state = 7;
  for (auto& c : cost) {
    state = state * 1664525U + 1013904223U;
    c = static_cast<std::uint8_t>((state >> 24) % (kLargestCost + 1));
  }
  return cost;
}

TEST(RowPathCosts, MatchTheDefinitionInBothDirections) {
  const std::vector<std::uint8_t> cost = some_costs();
  std::vector<std::uint8_t> steps(kWidth, 90);
  steps[4] = 12;
  steps[9] = kLargestStep;
  std::vector<std::uint16_t> sum(cost.size());
  RowPaths(kStride, kSmallStepShare).add(cost.data(), steps, sum.data());

  // Leftwards the same path runs over the mirrored row.
  std::vector<std::uint8_t> mirrored(cost.size());
  std::vector<std::uint8_t> mirrored_steps(kWidth);
  for (int x = 0; x < kWidth; ++x) {
    std::copy_n(cost.begin() + x * kStride, kStride, mirrored.begin() + (kWidth - 1 - x) * kStride);
    if (x > 0) mirrored_steps[static_cast<std::size_t>(x)] = steps[static_cast<std::size_t>(kWidth - x)];
  }
  const std::vector<int> right = path_by_definition(cost, steps, kSmallStepShare);
  const std::vector<int> left = path_by_definition(mirrored, mirrored_steps, kSmallStepShare);
  for (int x = 0; x < kWidth; ++x)
    for (int d = 0; d < kStride; ++d)
      EXPECT_EQ(sum[static_cast<std::size_t>(x * kStride + d)],
                right[static_cast<std::size_t>(x * kStride + d)] +
                    left[static_cast<std::size_t>((kWidth - 1 - x) * kStride + d)])
          << x << ' ' << d;
}

TEST(ColumnPathCosts, PropagateIntoARowWithoutTexture) {
  std::vector<std::uint8_t> telling(static_cast<std::size_t>(kWidth * kStride), 100);
  for (int x = 0; x < kWidth; ++x) telling[static_cast<std::size_t>(x * kStride + 9)] = 0;
  const std::vector<std::uint8_t> plain(telling.size(), 50);
  RowSteps steps(kWidth);
  for (auto* s : {&steps.before_left, &steps.before, &steps.before_right})
    std::fill(s->begin(), s->end(), std::uint8_t{60});
  std::vector<std::uint16_t> first(telling.size());
  std::vector<std::uint16_t> second(telling.size());
  ColumnPaths paths(kWidth, kStride, kSmallStepShare);
  paths.add(telling.data(), steps, SumState::begins, first.data());
  paths.add(plain.data(), steps, SumState::continues, second.data());
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(least_at(second.data() + x * kStride, kStride), 9) << x;
}

TEST(ColumnPathCosts, OverwriteASumThatBegins) {
  std::vector<std::uint8_t> cost(static_cast<std::size_t>(kWidth * kStride), 5);
  for (std::size_t i = 0; i < cost.size(); i += 7) cost[i] = 1;
  const RowSteps steps(kWidth);
  std::vector<std::uint16_t> clean(cost.size());
  std::vector<std::uint16_t> used(cost.size(), 1234);
  ColumnPaths(kWidth, kStride, kSmallStepShare).add(cost.data(), steps, SumState::continues, clean.data());
  ColumnPaths(kWidth, kStride, kSmallStepShare).add(cost.data(), steps, SumState::begins, used.data());
  EXPECT_EQ(used, clean);
}

TEST(LeastCost, IsTheFirstOfEqualCostsWithTheBestElsewhere) {
  const std::vector<std::uint16_t> costs{9, 4, 3, 3, 7, 5, 8};
  const LeastCost least = least_cost(costs.data(), static_cast<int>(costs.size()));
  EXPECT_EQ(least.at, 2);
  EXPECT_EQ(least.cost, 3);
  EXPECT_EQ(least.elsewhere, 5);  // not 3 and 4, which are neighbours
}

TEST(LeastCost, IsFoundAtEveryIndex) {
  for (const std::size_t count : {std::size_t{32}, std::size_t{64}, std::size_t{75}})
    for (std::size_t at = 0; at < count; ++at) {
      std::vector<std::uint16_t> costs(count, 60000);
      const std::size_t other = (at + 40) % count;
      costs[other] = 41000;
      costs[at] = 40000;
      if (at > 0) costs[at - 1] = 40500;
      const LeastCost least = least_cost(costs.data(), static_cast<int>(count));
      const bool beside = other + 1 == at || other == at || other == at + 1;
      EXPECT_EQ(least.at, static_cast<int>(at));
      EXPECT_EQ(least.cost, 40000);
      EXPECT_EQ(least.elsewhere, beside ? 60000 : 41000) << count << ' ' << at;
      EXPECT_EQ(least_at(costs.data(), static_cast<int>(count)), static_cast<int>(at));
    }
}

}  // namespace
}  // namespace palpable::vision
