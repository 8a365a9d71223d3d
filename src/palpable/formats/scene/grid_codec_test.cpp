// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/models/scene/test_grid.hpp"

#include <random>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

models::Scene grid_scene() {
  std::mt19937 random(3);
  return models::grid_scene({21, 17, 9}, 0.003F, [&](int) { return random() % 4 == 0; });
}

TEST(GridScene, KeepsEveryPoint) {
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

TEST(GridScene, IsRefusedOrValidWhenDamaged) {
  const auto file = encode_scene(grid_scene());
  ASSERT_TRUE(file.has_value());
  // A changed byte is either detected or leaves a valid scene; it never causes a crash.
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
