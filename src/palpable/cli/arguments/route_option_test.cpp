// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/route_option.hpp"

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/describe/place_words.hpp"

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

/// 500 m: High Street from west to east, Mill Lane north and Far Lane south from it; Island Road apart.
models::Scene map_scene() {
  StreetMap map;
  map.width_px = map.height_px = 500;
  map.metres_per_px = 1.0;
  map.streets = {{"High Street", 6.0, {{0, 250}, {100, 250}}},
                 {"High Street", 6.0, {{100, 250}, {400, 250}}},
                 {"Mill Lane", 6.0, {{100, 250}, {100, 50}}},
                 {"Far Lane", 6.0, {{400, 250}, {400, 450}}},
                 {"Island Road", 6.0, {{200, 400}, {300, 400}}}};
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(
      *models::Relief::from_samples(Raster<float>(51, 51, 0.001F), 0.1 / 51));
  scene.map = std::make_shared<const StreetMap>(map);
  scene.materials.clear();
  for (const char* name : {"land", "street", "High Street", "Mill Lane", "Far Lane", "Island Road"}) {
    models::Material material;
    material.name = name;
    scene.materials.push_back(material);
  }
  return scene;
}

TEST(Route, MakesItsStreetsSmoothAndOthersRough) {
  models::Scene scene = map_scene();
  const auto words = apply_route("Mill Lane to Far Lane", {}, scene);
  ASSERT_TRUE(words);
  ASSERT_EQ(words->size(), 5U);
  EXPECT_EQ((*words)[0], "The route from Mill Lane to Far Lane, 500 metres.");
  EXPECT_EQ((*words)[2], "Turn left into High Street, go east for 300 metres.");
  EXPECT_DOUBLE_EQ(scene.materials[0].static_friction, models::Material{}.static_friction);
  EXPECT_DOUBLE_EQ(scene.materials[1].static_friction, 0.6);
  for (const std::size_t k : {2U, 3U, 4U}) EXPECT_DOUBLE_EQ(scene.materials[k].static_friction, 0.05);
  EXPECT_DOUBLE_EQ(scene.materials[5].static_friction, 0.6);
  EXPECT_NE(scene.description.find("Turn left into High Street"), std::string::npos);
}

TEST(Route, GuidesAlongItsStreetsAndNamesItsEnd) {
  models::Scene scene = map_scene();
  ASSERT_TRUE(apply_route("Mill Lane to Far Lane", {}, scene));
  ASSERT_NE(scene.guide, nullptr);
  EXPECT_TRUE(models::is_valid(*scene.guide));
  // 500 of 500 metres on a plate of 100 mm.
  EXPECT_NEAR(models::length_m(*scene.guide), 0.1, 1e-4);
  EXPECT_DOUBLE_EQ(scene.guide->force_N, 0.5);
  // Mill Lane's middle is at 100, 150 of 500 pixels.
  EXPECT_NEAR(scene.guide->line_m.front()[0], -0.03, 2e-4);
  EXPECT_NEAR(scene.guide->line_m.front()[1], 0.02, 2e-4);
  RouteGuidance none;
  none.pull_N = 0.0;
  ASSERT_TRUE(apply_route("Mill Lane to Far Lane", none, scene));
  ASSERT_NE(scene.guide, nullptr);
  EXPECT_EQ(scene.guide->force_N, 0.0);
  // Far Lane's middle is at 400, 350 of 500 pixels.
  EXPECT_EQ(describe::name_at(scene, {0.0301, -0.0205}), "the end of the route");
  EXPECT_NE(describe::name_at(scene, {0.0301, -0.015}), "the end of the route");
}

TEST(Route, RefusesScenesWithoutMapsAndPlacesThatNothingConnects) {
  models::Scene scene = map_scene();
  EXPECT_EQ(apply_route("Mill Lane to Island Road", {}, scene).error().code, ErrorCode::usage);
  EXPECT_EQ(apply_route("Mill Lane to Nowhere Road", {}, scene).error().code, ErrorCode::usage);
  scene.map = nullptr;
  EXPECT_EQ(apply_route("A to B", {}, scene).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::cli
