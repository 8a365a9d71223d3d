// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/surface_cells.hpp"

#include <bit>
#include <memory>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::page {
namespace {

/// A level surface at 3 mm; on the left in cells of 4 mm, on the right in one cell of 8 mm.
models::Scene level_field() {
  const auto w = [](float v) { return std::bit_cast<std::uint32_t>(v); };
  constexpr std::uint32_t kLeaf = models::FieldTree::kLeaf;
  models::FieldTree tree;
  tree.words = {0U, w(0), w(0), w(1), w(-0.003F)};
  tree.nodes = std::vector<std::uint32_t>(8, kLeaf);
  tree.roots = {0U, kLeaf};
  auto distance = models::DistanceField::from_tree({{-0.008, -0.004, 0.0}, 0.001, 3, {2, 1, 1}}, tree,
                                                   {1e-5, 2e-5, 3e-5});
  models::Scene scene;
  scene.model = std::make_shared<const models::Field>(
      *models::field_of(*std::move(distance), {-0.0079, -0.0039, 0.0}, {0.0079, 0.0039, 0.003}));
  return scene;
}

bool is_line(Rgb8 c) { return c.r < 35 && c.g < 35 && c.b < 35; }

TEST(SurfaceCells, ShowsWhereCellsMeetAndWhichAreFiner) {
  const auto cells = surface_cells(level_field());
  ASSERT_TRUE(cells);
  EXPECT_THAT(cells->words, testing::HasSubstr("9 cells; at the surface they are 4 to 8 mm wide"));
  const auto& picture = cells->picture;
  const int wide = picture.width(), high = picture.height();
  EXPECT_GT(picture(wide / 8, high / 4).r, picture(3 * wide / 4, high / 4).r);
  int left = 0, right = 0, across = 0;
  for (int j = 0; j < high; ++j) {
    left += is_line(picture(wide / 8, j)) ? 1 : 0;
    right += is_line(picture(7 * wide / 8, j)) ? 1 : 0;
  }
  for (int i = 0; i < wide; ++i) across += is_line(picture(i, high / 4)) ? 1 : 0;
  EXPECT_EQ(left, 1);
  EXPECT_EQ(right, 0);
  EXPECT_EQ(across, 2);
}

TEST(SurfaceCells, AreAbsentInASceneWithoutAField) { EXPECT_FALSE(surface_cells(models::Scene{})); }

}  // namespace
}  // namespace palpable::page
