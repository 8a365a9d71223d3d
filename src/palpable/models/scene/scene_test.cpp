// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/scene/scene.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

/// 20 x 10 mm; label 0 upper left, 1 upper right, 2 below.
Scene three_materials() {
  Scene scene;
  scene.model = std::make_shared<const Relief>(*Relief::from_samples(Raster<float>(20, 10, 0.001F), 0.001));
  scene.materials.resize(3);
  scene.labels = Raster<std::uint8_t>(2, 2);
  scene.labels(1, 0) = 1;
  scene.labels(0, 1) = 2;
  scene.labels(1, 1) = 2;
  return scene;
}

TEST(LabelAt, FindsTheLabelAtAPlaceAndTheNearestOneOutside) {
  const Scene scene = three_materials();
  EXPECT_EQ(label_at(scene, {{-0.005, 0.002, 0.0}}), 0U);
  EXPECT_EQ(label_at(scene, {{0.005, 0.002, 0.0}}), 1U);
  EXPECT_EQ(label_at(scene, {{0.005, -0.002, 0.0}}), 2U);
  EXPECT_EQ(label_at(scene, {{1.0, 1.0, 0.0}}), 1U);
}

TEST(LabelAt, IsAlwaysAValidIndex) {
  Scene scene = three_materials();
  scene.materials.resize(2);
  EXPECT_EQ(label_at(scene, {{0.005, -0.002, 0.0}}), 1U);
  EXPECT_EQ(label_at(scene, {{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}}), 0U);
  scene.labels = {};
  EXPECT_EQ(label_at(scene, {{0.005, -0.002, 0.0}}), 0U);
}

}  // namespace
}  // namespace palpable::models
