// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/view_shift.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

models::Relief slope() {
  Raster<float> height_m(40, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) height_m(x, y) = 0.0002F * static_cast<float>(x);
  return *models::Relief::from_samples(std::move(height_m), 0.001);
}

TEST(ViewShift, MovesAReliefByWholeSamplesAndKeepsItsBorder) {
  const auto relief = slope();
  const auto moved = shifted(relief, {{0.0051, 0.0, 0.001}});
  ASSERT_TRUE(moved);
  EXPECT_NEAR((*moved)->sample(0.005, 0.0).z_m, relief.sample(0.0, 0.0).z_m + 0.001, 1e-7);
  // To the left of what was the left border.
  EXPECT_FLOAT_EQ((*moved)->samples_m()(2, 10), 0.001F);
  EXPECT_EQ((*shifted(relief, {{0.0, 0.0, -1.0}}))->highest_m(), 0.0);
}

TEST(ViewShift, GoesBackSlowlyAndNotBeyond) {
  ViewShift shift{{0.03, -0.04, 0.006}};
  shift = relaxed(shift, 0.1);
  EXPECT_NEAR(std::hypot(shift.by_m.x, shift.by_m.y), 0.049, 1e-12);
  EXPECT_NEAR(shift.by_m.x / shift.by_m.y, -0.75, 1e-12);
  EXPECT_NEAR(shift.by_m.z, 0.0057, 1e-12);
  EXPECT_EQ(relaxed(shift, 60.0), ViewShift{});
}

TEST(ViewShift, HasNoPointWithoutDepthOrCamera) {
  const auto relief = slope();
  const Raster<float> unknown(40, 30, kUnknownDepth), near(40, 30, 0.5F);
  const Pinhole camera{40.0, 40.0, 19.5, 14.5, 40, 30};
  EXPECT_FALSE(point_under({relief, unknown, camera, {}}, {}, {}));
  EXPECT_FALSE(point_under({relief, near, std::nullopt, {}}, {}, {}));
  const auto point = point_under({relief, near, camera, {}}, {}, {0.01, 0.0, 0.0});
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->v.x, 0.5 * 10.0 / 40.0, 0.5 / 40.0);
  const auto place = place_of({relief, near, camera, {}}, *point);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, 0.01, 0.001);
}

}  // namespace
}  // namespace palpable::session
