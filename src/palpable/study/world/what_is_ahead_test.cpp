// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/what_is_ahead.hpp"

#include "palpable/study/world/robot_world.hpp"
#include "palpable/vision/depth_camera/depth_noise.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

using session::ThingAhead;
using session::ThingKind;

Solid box(double x_m, double y_m, double low_m, double high_m, double half_x_m, double half_y_m) {
  return {
      Solid::Shape::box, {x_m, y_m, 0.5 * (low_m + high_m)}, {half_x_m, half_y_m, 0.5 * (high_m - low_m)}, 0};
}

/// A table with four legs, its near edge 0.8 m before the middle of the room.
std::vector<Solid> table() {
  std::vector<Solid> solids{box(1.15, 0.0, 0.68, 0.72, 0.35, 0.6)};
  for (const double x_m : {0.85, 1.45})
    for (const double y_m : {-0.55, 0.55}) solids.push_back(box(x_m, y_m, -0.01, 0.7, 0.03, 0.03));
  return solids;
}

/// What a robot in the middle of a room of 6 x 5 m, which looks along x, has before it.
struct Before {
  explicit Before(std::vector<Solid> solids, FloorPose pose = {})
      : world(Room{{6.0, 5.0, 2.5}, {}, {}, {}, {{"thing", {}, std::move(solids)}}}, {}, {}, 1) {
    const RobotBody& body = world.body();
    world.place(pose);
    shape = {body.radius_m, body.height_m, body.camera_height_m, body.camera_forward_m, body.camera_down_rad};
    depth = {world.view(camera, {vision::DepthNoise{}, 0.25, 6.0, 0.0, 3}).depth_m, camera};
  }
  std::optional<ThingAhead> thing() const { return session::thing_ahead(depth, shape); }

  Pinhole camera = camera_of(160, 120, 1.52);
  RobotWorld world;
  session::RobotShape shape;
  DepthMap depth;
};

TEST(ThingAhead, IsATableByItsHeightAndTheSpaceBelow) {
  const auto thing = Before(table()).thing();
  ASSERT_TRUE(thing);
  EXPECT_EQ(thing->kind, ThingKind::table);
  EXPECT_NEAR(thing->distance_m, 0.6, 0.06);
  EXPECT_NEAR(thing->width_m, 1.2, 0.11);
  ASSERT_TRUE(thing->top_m);
  EXPECT_NEAR(*thing->top_m, 0.72, 0.03);
}

TEST(ThingAhead, IsSomethingOfItsSize) {
  const auto thing = Before({box(1.0, 0.1, -0.01, 0.45, 0.15, 0.2)}).thing();
  ASSERT_TRUE(thing);
  EXPECT_EQ(thing->kind, ThingKind::other);
  EXPECT_NEAR(thing->distance_m, 0.65, 0.06);
  EXPECT_NEAR(thing->width_m, 0.4, 0.11);
  EXPECT_NEAR(thing->top_m.value_or(0.0), 0.45, 0.03);
  const auto tall = Before({box(1.0, 0.1, -0.01, 1.8, 0.15, 0.2)}).thing();
  ASSERT_TRUE(tall);
  EXPECT_EQ(tall->kind, ThingKind::other);
  EXPECT_FALSE(tall->top_m);
}

TEST(ThingAhead, IsAWallWhereItIsPlaneAlsoIfItIsOblique) {
  for (const double heading_rad : {0.0, 0.4, -0.6}) {
    const double away_m = 1.2;
    const auto thing = Before({}, {3.0 - away_m, 0.0, heading_rad}).thing();
    ASSERT_TRUE(thing) << heading_rad;
    EXPECT_EQ(thing->kind, ThingKind::wall) << heading_rad;
    EXPECT_LT(thing->distance_m, away_m) << heading_rad;
    EXPECT_GT(thing->distance_m, 0.5) << heading_rad;
  }
}

TEST(ThingAhead, IsNoneWhereTheWayIsFree) {
  EXPECT_FALSE(Before({}, {-2.5, 0.0, 0.0}).thing());
  // Beside the way.
  EXPECT_FALSE(Before({box(1.0, 0.6, -0.01, 0.4, 0.1, 0.1)}, {-1.0, 0.0, 0.0}).thing());
  EXPECT_FALSE(session::thing_ahead({Raster<float>(160, 120), {}}, {}));
}

TEST(ThingAhead, IsSaidInASentence) {
  EXPECT_EQ(session::sentence_of({ThingKind::table, 0.61, 1.12, false, 0.72}),
            "A table, 60 cm ahead: 110 cm wide, 70 cm high.");
  EXPECT_EQ(session::sentence_of({ThingKind::wall, 1.0, 3.0, true, {}}), "A wall, 100 cm ahead.");
  EXPECT_EQ(session::sentence_of({ThingKind::other, 0.3, 0.4, true, {}}),
            "Something, 30 cm ahead: at least 40 cm wide, higher than the picture.");
}

TEST(AheadWatch, SaysAThingOnceWhileTheRobotStands) {
  const Before table_ahead(table()), wall_ahead({}, {1.8, 0.0, 0.0});
  session::AheadWatch watch;
  int said = 0;
  const auto look = [&](const Before& at, double t_s, bool stands) {
    const auto words = watch.look(t_s, at.depth, at.shape, stands);
    said += words ? 1 : 0;
    return words.value_or("");
  };
  EXPECT_EQ(look(table_ahead, 0.0, false), "");
  EXPECT_EQ(look(table_ahead, 0.1, true), "");
  EXPECT_TRUE(look(table_ahead, 0.2, true).starts_with("A table, 60 cm ahead"));
  for (int k = 3; k < 60; ++k) look(table_ahead, 0.1 * k, true);
  EXPECT_EQ(said, 1);
  look(wall_ahead, 6.0, true);
  EXPECT_TRUE(look(wall_ahead, 6.1, true).starts_with("A wall"));
}

}  // namespace
}  // namespace palpable::study
