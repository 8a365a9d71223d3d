// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene_file.hpp"

#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

models::Scene grid_scene() {
  auto relief = models::Relief::from_samples(Raster<float>(20, 16, 0.003F), 0.001);
  EXPECT_TRUE(relief.has_value());
  models::Occupancy o;
  o.counts = {21, 17, 9};
  o.origin_m = {-0.01, -0.008, -0.001};
  o.spacing_m = 0.001;
  std::mt19937 random(3);
  for (int i = 0; i < 21 * 17 * 9; ++i) o.occupied.push_back(random() % 4 == 0 ? 1 : 0);
  auto grid = models::OccupancyGrid::from(o, Work{});
  EXPECT_TRUE(grid.has_value());
  models::Scene scene;
  scene.model = std::make_shared<const models::Grid>(
      models::Grid{*std::move(grid), std::make_shared<const models::Relief>(*std::move(relief))});
  return scene;
}

TEST(GridScene, ComesBackPointByPoint) {
  const models::Scene scene = grid_scene();
  const auto file = encode_scene(scene);
  ASSERT_TRUE(file.has_value());
  const auto read = decode_scene(*file);
  ASSERT_TRUE(read.has_value());
  const auto& before = std::get<std::shared_ptr<const models::Grid>>(scene.model)->occupancy;
  const auto& after = std::get<std::shared_ptr<const models::Grid>>(read->scene.model)->occupancy;
  EXPECT_EQ(after.occupancy().occupied, before.occupancy().occupied);
  EXPECT_EQ(after.counts(), before.counts());
  EXPECT_EQ(after.origin_m(), before.origin_m());
}

TEST(GridScene, IsRefusedWhenDamagedAnywhere) {
  const auto file = encode_scene(grid_scene());
  ASSERT_TRUE(file.has_value());
  // A changed byte either is noticed or leaves a scene that is sound: never a crash.
  for (std::size_t at = 0; at < file->size(); at += 7) {
    auto damaged = *file;
    damaged[at] ^= std::byte{0x55};
    static_cast<void>(decode_scene(damaged));
  }
  for (std::size_t size = 0; size < file->size(); size += 97)
    EXPECT_FALSE(decode_scene(std::span(*file).first(size)).has_value());
}

}  // namespace
}  // namespace palpable::formats
