// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/segment_features.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// Cells of 8 x 6: a label, and a lightness.
struct Cells {
  Raster<int> labels{8, 6, 1};
  Raster<SegmentFeature> features{8, 6};

  void fill(int left, int top, int width, int height, int label, float lightness) {
    for (int y = top; y < top + height; ++y)
      for (int x = left; x < left + width; ++x) {
        labels(x, y) = label;
        features(x, y).appearance[0] = lightness;
        features(x, y).position = {static_cast<float>(x), static_cast<float>(y)};
      }
  }
  SegmentComponents merged(const SegmentMergeOptions& options) const {
    return merged_components(labels, features, options);
  }
};

Cells two_halves(float right) {
  Cells cells;
  cells.fill(0, 0, 4, 6, 1, 0.0F);
  cells.fill(4, 0, 4, 6, 2, right);
  return cells;
}

TEST(SegmentFeatures, DifferByTheirAppearanceAlone) {
  SegmentFeature a, b;
  a.position = {5.0F, 5.0F};
  b.appearance = {1.0F, 0.0F, 2.0F, 0.0F, 0.0F, 2.0F};
  EXPECT_EQ(squared_difference(a, b), 9.0F);
  EXPECT_EQ(squared_difference(a, a), 0.0F);
}

TEST(SegmentFeatures, ComponentsAreMeansOfTheirCells) {
  const auto found = two_halves(1.0F).merged({});
  ASSERT_EQ(found.components.size(), 2U);
  const SegmentCentre& right = found.components[static_cast<std::size_t>(found.of_cell(7, 0))];
  EXPECT_EQ(right.identity, 2);
  EXPECT_EQ(right.cells, 24);
  EXPECT_FLOAT_EQ(right.mean.appearance[0], 1.0F);
  EXPECT_FLOAT_EQ(right.mean.position[0], 5.5F);
  EXPECT_FLOAT_EQ(right.mean.position[1], 2.5F);
  EXPECT_NE(found.of_cell(3, 3), found.of_cell(4, 3));
}

TEST(SegmentFeatures, EqualLabelsApartAreTwoComponents) {
  Cells cells = two_halves(1.0F);
  cells.fill(0, 0, 8, 2, 3, 0.5F);
  cells.fill(0, 4, 8, 2, 3, 0.5F);
  EXPECT_EQ(cells.merged({0, 0.0}).components.size(), 4U);
}

TEST(SegmentFeatures, PartsWithoutAnInteriorJoinTheMoreSimilarNeighbour) {
  Cells cells = two_halves(1.0F);
  // On the border between the halves, nearer to the right one's lightness.
  cells.fill(3, 2, 1, 1, 9, 0.8F);
  const auto found = cells.merged({1, 0.0});
  ASSERT_EQ(found.components.size(), 2U);
  EXPECT_EQ(found.of_cell(3, 2), found.of_cell(7, 5));
  EXPECT_EQ(found.components[static_cast<std::size_t>(found.of_cell(3, 2))].cells, 25);
}

TEST(SegmentFeatures, SimilarNeighboursBecomeOneWithTheOlderIdentity) {
  const auto merged = two_halves(0.3F).merged({1, 0.5});
  ASSERT_EQ(merged.components.size(), 1U);
  EXPECT_EQ(merged.components[0].identity, 1);
  EXPECT_FLOAT_EQ(merged.components[0].mean.appearance[0], 0.15F);
  EXPECT_EQ(two_halves(0.6F).merged({1, 0.5}).components.size(), 2U);
  // A label below 0 is no identity.
  Cells unknown = two_halves(0.3F);
  unknown.fill(0, 0, 4, 6, -1, 0.0F);
  EXPECT_EQ(unknown.merged({1, 0.5}).components[0].identity, 2);
}

}  // namespace
}  // namespace palpable::vision
