// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/route_option.hpp"

#include "palpable/core/geometry/street_map.hpp"

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

TEST(Route, RefusesScenesWithoutMapsAndPlacesThatNothingConnects) {
  models::Scene scene = map_scene();
  EXPECT_EQ(apply_route("Mill Lane to Island Road", {}, scene).error().code, ErrorCode::usage);
  EXPECT_EQ(apply_route("Mill Lane to Nowhere Road", {}, scene).error().code, ErrorCode::usage);
  scene.map = nullptr;
  EXPECT_EQ(apply_route("A to B", {}, scene).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::cli
