// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/boundary_score.hpp"

#include <gtest/gtest.h>

namespace palpable::measure {
namespace {

/// Strength `s` down column x.
Raster<float> column(int x, float s) {
  Raster<float> line(100, 80);
  for (int y = 0; y < 80; ++y) line(x, y) = s;
  return line;
}

Raster<std::uint8_t> drawn_column(int x) {
  Raster<std::uint8_t> truth(100, 80);
  for (int y = 0; y < 80; ++y) truth(x, y) = 1;
  return truth;
}

BoundaryCounts at(const Raster<float>& line, const std::vector<Raster<std::uint8_t>>& truths,
                  double threshold = 0.5) {
  auto counts = score_boundary(line, truths, {0.02, {threshold}}, Work{});  // 2 % of 128 px: 2.56 px
  EXPECT_TRUE(counts);
  return counts->front();
}

TEST(BoundaryScore, IsOneForABoundaryWithinTheTolerance) {
  EXPECT_DOUBLE_EQ(at(column(50, 0.9F), {drawn_column(52)}).f_measure(), 1.0);
}

TEST(BoundaryScore, IsZeroForABoundaryBeyondTheTolerance) {
  EXPECT_DOUBLE_EQ(at(column(50, 0.9F), {drawn_column(53)}).f_measure(), 0.0);
}

TEST(BoundaryScore, CountsADoubledLineAsHalfWrong) {
  Raster<float> doubled = column(50, 0.9F);
  for (int y = 0; y < 80; ++y) doubled(51, y) = 0.9F;
  const BoundaryCounts counts = at(doubled, {drawn_column(50)});
  EXPECT_DOUBLE_EQ(counts.precision(), 0.5);
  EXPECT_DOUBLE_EQ(counts.recall(), 1.0);
}

TEST(BoundaryScore, FindsThePairingThatGreedyMisses) {
  // Both found pixels have the same nearest drawn pixel; only a maximum matching pairs both.
  Raster<float> line(100, 80);
  line(10, 10) = line(14, 10) = 1.0F;
  Raster<std::uint8_t> truth(100, 80);
  truth(12, 10) = truth(15, 10) = 1;
  EXPECT_EQ(at(line, {truth}).wanted_found, 2);
  line(10, 10) = 0.0F;
  line(13, 10) = 1.0F;
  EXPECT_EQ(at(line, {truth}).wanted_found, 2);
}

TEST(BoundaryScore, TakesEveryPersonsTruthForPrecisionAndTheirSumForRecall) {
  const BoundaryCounts counts = at(column(50, 0.9F), {drawn_column(50), drawn_column(20)});
  EXPECT_DOUBLE_EQ(counts.precision(), 1.0);
  EXPECT_DOUBLE_EQ(counts.recall(), 0.5);
}

TEST(BoundaryScore, IgnoresStrengthsBelowTheThreshold) {
  EXPECT_EQ(at(column(50, 0.4F), {drawn_column(50)}).found, 0);
}

TEST(BoundaryScore, RefusesSizesThatDifferAndAMissingTruth) {
  EXPECT_FALSE(score_boundary(column(5, 1.0F), {Raster<std::uint8_t>(10, 10)}, {}, Work{}));
  EXPECT_FALSE(score_boundary(column(5, 1.0F), {}, {}, Work{}));
}

TEST(BoundaryOfLabels, RunsBetweenTheLabels) {
  Raster<float> labels(4, 3);
  for (int y = 0; y < 3; ++y) labels(2, y) = labels(3, y) = 7.0F;
  const auto boundary = boundary_of_labels(labels);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(boundary(x, y), x == 1 ? 1 : 0);
}

}  // namespace
}  // namespace palpable::measure
