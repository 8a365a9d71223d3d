// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/model_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

struct Block {
  Vec3 least, most;
};

// Random points on the top and the sides of blocks on a table at height 0.
VideoModel model_of(const std::vector<Block>& blocks) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  VideoModel model;
  model.least = {-0.8, -0.5, -0.1}, model.most = {0.8, 0.5, 1};
  for (const Block& block : blocks)
    for (int i = 0; i < 4000; ++i) {
      const Vec3 size = block.most - block.least;
      Vec3 p = block.least + Vec3{unit(random) * size.x, unit(random) * size.y, unit(random) * size.z};
      switch (i % 5) {
        case 0:
          p.x = block.least.x;
          break;
        case 1:
          p.x = block.most.x;
          break;
        case 2:
          p.y = block.least.y;
          break;
        case 3:
          p.y = block.most.y;
          break;
        default:
          p.z = block.most.z;
          break;
      }
      if (p.z > 0.02) model.raised.push_back(p);
    }
  return model;
}

TEST(ModelShapes, GivesEachObjectItsOwnShapeOnThePlate) {
  const std::vector<Block> blocks{{{-0.6, -0.3, 0}, {-0.2, 0.3, 0.5}}, {{0.2, -0.2, 0}, {0.6, 0.2, 0.25}}};
  const auto found = shapes_of_model(model_of(blocks), {}, {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->objects, 2U);
  ASSERT_GE(found->shapes.size(), 3U);
  for (const Block& block : blocks) {
    // The middle of each block is solid, and its upper corners' surroundings are not.
    const Vec3 middle = 0.5 * (block.least + block.most);
    const auto inside = [&](Vec3 p) {
      return std::any_of(found->shapes.begin(), found->shapes.end(),
                         [&](const auto& shape) { return models::inside_outside(shape, {p}) < 1; });
    };
    EXPECT_TRUE(inside(middle));
    EXPECT_TRUE(inside({middle.x, middle.y, 0.9 * block.most.z}));
    EXPECT_FALSE(inside({middle.x, middle.y, block.most.z + 0.06}));
    EXPECT_FALSE(inside({block.least.x - 0.06, middle.y, middle.z}));
  }
}

TEST(ModelShapes, IsThePlateWhereNothingIsRaised) {
  VideoModel model;
  model.least = {-1, -0.5, -0.1}, model.most = {1, 0.5, 0.1};
  const auto found = shapes_of_model(model, {}, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->objects, 0U);
  ASSERT_EQ(found->shapes.size(), 1U);
  EXPECT_NEAR(found->shapes[0].size_m.x, 1.0, 1e-12);
  EXPECT_NEAR(found->shapes[0].size_m.y, 0.5, 1e-12);
  EXPECT_NEAR(found->shapes[0].scene_from_shape.translation_m.z + found->shapes[0].size_m.z, 0.0, 1e-12);
}

}  // namespace
}  // namespace palpable::recipes
