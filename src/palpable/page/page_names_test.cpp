// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_names.hpp"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::page {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A level plate of 100 x 100 mm with two written names.
models::Scene plate() {
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(
      *models::Relief::from_samples(Raster<float>(100, 100, 0.001F), 0.001));
  scene.names = {{"gate", "It is locked.", {0.03, 0.0}}, {"well", {}, {-0.01, 0.0}}};
  return scene;
}

protocol::Ask way_from(double x_m, double y_m) {
  protocol::Ask ask;
  ask.what = "way";
  ask.x_m = x_m;
  ask.y_m = y_m;
  return ask;
}

TEST(PageNames, AreListedTheNearestFirst) {
  PageNames names;
  const auto around = names.around(plate(), {7, 0.0, 0.0});
  ASSERT_EQ(around.places.size(), 2U);
  EXPECT_EQ(around.serial, 7);
  EXPECT_EQ(around.places[0].words, "well, 10 millimetres left");
  EXPECT_EQ(around.places[1].words, "gate, 30 millimetres right");
  EXPECT_TRUE(around.places[0].written);
  EXPECT_FALSE(around.places[0].here);
}

TEST(PageNames, ThatAreEqualAtNearlyOnePlaceAreToldApart) {
  PageNames names;
  auto scene = plate();
  scene.names = {{"bench", {}, {0.03, 0.0}}, {"gate", {}, {0.0, 0.0}}, {"bench", {}, {0.031, 0.001}}};
  const auto around = names.around(scene, {7, 0.03, 0.0});
  ASSERT_EQ(around.places.size(), 3U);
  EXPECT_EQ(around.places[0].words, "bench, here, 1 of 2, 30 millimetres right from the middle");
  EXPECT_EQ(around.places[1].words,
            "bench, here, 2 of 2, 31 millimetres right, 1 millimetre up from the middle");
  EXPECT_EQ(around.places[2].words, "gate, 30 millimetres left");
}

TEST(PageNames, LeadAProbeToTheirPlaceUntilItIsThere) {
  PageNames names;
  const auto scene = plate();
  const auto around = names.around(scene, {});
  ASSERT_TRUE(names.find(scene, {0, around.list, around.places[1].place, 0.0, 0.0}));
  const auto way = names.way(scene, way_from(0.0, 0.0));
  EXPECT_EQ(way.text, "Gate: 30 millimetres right.");
  EXPECT_NEAR(*way.x_m, 0.03, 1e-12);
  const auto there = names.way(scene, way_from(0.029, 0.001));
  EXPECT_EQ(there.text, "Here: gate. It is locked.");
  EXPECT_FALSE(there.x_m);
  // Keys may only have passed by: the page ends it.
  EXPECT_EQ(names.way(scene, way_from(0.0, 0.0)).text, "Gate: 30 millimetres right.");
  ASSERT_TRUE(names.find(scene, {0, around.list, {}, 0.0, 0.0}));
  EXPECT_EQ(names.way(scene, way_from(0.0, 0.0)).text, "");
}

TEST(PageNames, RefuseAnOlderList) {
  PageNames names;
  auto scene = plate();
  const auto before = names.around(scene, {});
  const auto edited = names.edited(scene, protocol::Name{before.list, {}, "tree", {}, 0.0, 0.02});
  ASSERT_TRUE(edited);
  scene.names = edited->names;
  const auto after = names.around(scene, {});
  EXPECT_EQ(after.places.size(), 3U);
  EXPECT_THAT(names.edited(scene, protocol::Unname{before.list, 0}).error().message,
              HasSubstr("names have changed"));
  EXPECT_FALSE(names.find(scene, {0, before.list, 0, 0.0, 0.0}));
  EXPECT_THAT(names.edited(scene, protocol::Unname{after.list, 0})->words, StartsWith("Deleted: gate"));
}

}  // namespace
}  // namespace palpable::page
