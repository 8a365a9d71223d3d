// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The sweep of a wrist camera, its depth and the zoom, of a simulated robot before a table.
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/sculpt/relief/relief_in_window.hpp"
#include "palpable/session/robot/near_depth.hpp"
#include "palpable/session/robot/view_shift.hpp"
#include "palpable/study/world/test_sweep.hpp"

#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

void run_for(SweptRobot& robot, double seconds) {
  for (const double end_s = robot.world.time_s() + seconds; robot.world.time_s() < end_s;) robot.step();
}

TEST(WristSweep, ComesHomeWithAPictureOfEachPlace) {
  SweptRobot robot(1);
  const auto pictures = robot.swept();
  ASSERT_TRUE(pictures) << robot.sweep.take_failure().value_or("");
  ASSERT_EQ(pictures->size(), 5U);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR((*pictures)[k].base_from_camera.translation_m.y, 0.015 * (static_cast<double>(k) - 2.0),
                0.0035);
  EXPECT_NEAR(robot.world.base_from_wrist().translation_m.y, 0.0, 0.0035);
  EXPECT_LT(robot.farthest_m, 0.035);
  EXPECT_FALSE(robot.world.has_touched());
}

TEST(WristSweep, StandsWhileItMayNotMoveAndGivesUpAfterTenSeconds) {
  SweptRobot robot(1);
  ASSERT_TRUE(robot.sweep.begin(robot.world.time_s()));
  run_for(robot, 0.5);
  EXPECT_NE(robot.command_m_per_s, 0.0);
  robot.may_move = false;
  robot.step();
  EXPECT_EQ(robot.command_m_per_s, 0.0);
  run_for(robot, 5.0);
  EXPECT_TRUE(robot.sweep.is_active());
  robot.may_move = true;
  run_for(robot, 0.5);
  EXPECT_NE(robot.command_m_per_s, 0.0);
  robot.may_move = false;
  run_for(robot, 11.0);
  EXPECT_FALSE(robot.sweep.is_active());
  EXPECT_NE(robot.sweep.take_failure().value_or("").find("given up"), std::string::npos);
}

TEST(WristSweep, GivesUpAnArmThatDoesOtherThanItIsTold) {
  // It says nothing, it stands, and it goes on.
  const auto failure_of = [](SweptRobot& robot, double seconds) {
    run_for(robot, seconds);
    EXPECT_EQ(robot.command_m_per_s, 0.0);
    return robot.sweep.take_failure().value_or("none");
  };
  SweptRobot silent(1), blocked(1), runaway(1);
  EXPECT_TRUE(silent.sweep.begin(silent.world.time_s()) && blocked.sweep.begin(blocked.world.time_s()) &&
              runaway.sweep.begin(runaway.world.time_s()));
  run_for(silent, 0.5);
  silent.arm_speaks = false;
  run_for(silent, 0.4);
  EXPECT_EQ(silent.command_m_per_s, 0.0);
  EXPECT_NE(failure_of(silent, 3.0).find("does not say where"), std::string::npos);
  blocked.arm_obeys = false;
  EXPECT_NE(failure_of(blocked, 3.0).find("may be blocked"), std::string::npos);
  run_for(runaway, 0.5);
  runaway.arm_obeys = false;
  for (int k = 0; k < 100; ++k) {
    runaway.world.command_arm(-0.06);
    runaway.step();
  }
  EXPECT_NE(failure_of(runaway, 0.1).find("left the way"), std::string::npos);
  // And it still does.
  for (int k = 0; k < 150; ++k) {
    runaway.world.command_arm(0.03);
    runaway.step();
  }
  EXPECT_NE(failure_of(runaway, 0.1).find("emergency stop"), std::string::npos);
}

TEST(WristSweep, DoesNotWanderWhereConnectionsAreLostAgainAndAgain) {
  SweptRobot robot(1);
  for (int k = 0; k < 6; ++k) {
    ASSERT_TRUE(robot.sweep.begin(robot.world.time_s()));
    // Long enough to be led back to its way.
    run_for(robot, 2.0);
    // Its driver goes on for a second; then somebody waits, now and then.
    robot.arm_obeys = false;
    robot.sweep.cancel();
    for (int n = 0; n < 50; ++n) {
      robot.world.command_arm(-0.03);
      robot.step();
    }
    run_for(robot, k % 3 == 0 ? 12.0 : 1.0);
    robot.arm_obeys = true;
  }
  // Half of its way, and what its driver goes on for.
  EXPECT_LT(robot.farthest_m, 0.03 + 0.04);
  const auto pictures = robot.swept();
  ASSERT_TRUE(pictures) << robot.sweep.take_failure().value_or("");
  EXPECT_NEAR(robot.world.base_from_wrist().translation_m.y, 0.0, 0.0035);
}

TEST(NearDepth, IsMetric) {
  SweptRobot robot(1);
  const auto pictures = robot.swept();
  ASSERT_TRUE(pictures);
  const auto near = session::near_depth(*pictures, robot.camera, {}, {});
  ASSERT_TRUE(near) << near.error().sentence();
  const auto truth = robot.world.wrist_view(robot.camera, {});
  std::vector<double> error;
  std::size_t count = 0;
  for (std::size_t k = 0; k < truth.depth_m.count(); ++k) {
    const double z = double{truth.depth_m.values()[k]};
    if (truth.object.values()[k] < 0 || z < 0.3 || z > 0.6) continue;
    ++count;
    if (const double found = double{near->depth.depth_m.values()[k]}; std::isfinite(found))
      error.push_back(std::abs(found / z - 1.0));
  }
  EXPECT_GT(error.size(), count * 7 / 10);
  EXPECT_LT(quantile_of(error, 0.5), 0.02);
  EXPECT_LT(quantile_of(error, 0.9), 0.05);
  EXPECT_FALSE(session::near_depth(std::span(*pictures).first(2), robot.camera, {}, {}));
}

TEST(NearView, TakesThePlaceOfTheWideOneUnderTheHand) {
  RobotWorld world(make_near_room(1), {}, {}, 1);
  world.place(near_place());
  const Pinhole wide_camera = camera_of(240, 180, 1.52), near_camera = camera_of(160, 120, 0.96);
  const auto wide_depth = world.view(wide_camera, {}).depth_m,
             near_depth = world.wrist_view(near_camera, {}).depth_m;
  const auto relief_of = [](const Raster<float>& depth_m) {
    return *sculpt::relief_in_window(depth_m, *vision::range_of_depths(depth_m), {});
  };
  const auto wide_relief = relief_of(wide_depth), near_relief = relief_of(near_depth);
  const session::TouchedView wide{wide_relief, wide_depth, wide_camera, world.world_from_camera()};
  const session::TouchedView near{near_relief, near_depth, near_camera, world.world_from_wrist()};
  // On the table, ahead of the robot.
  const auto on_table = session::place_of(wide, Point<WorldFrame>{{0.4, 0.02, 0.5}});
  ASSERT_TRUE(on_table);
  const auto before = session::point_under(wide, {}, *on_table);
  const auto to_near = session::zoomed_shift(wide, {}, near, *on_table, 0.002);
  const auto after = session::point_under(near, to_near.shift, *on_table);
  ASSERT_TRUE(before && after && to_near.point);
  EXPECT_LT(norm(*after - *before), 0.006);
  const auto height = [&](const models::Relief& relief, const session::ViewShift& shift) {
    return (*session::shifted(relief, shift))->sample(on_table->x, on_table->y).z_m;
  };
  EXPECT_NEAR(height(near_relief, to_near.shift), height(wide_relief, {}), 2e-4);
  const auto back = session::zoomed_shift(near, to_near.shift, wide, *on_table, 0.002);
  const auto again = session::point_under(wide, back.shift, *on_table);
  ASSERT_TRUE(again);
  EXPECT_LT(norm(*again - *before), 0.012);
  // What the wrist camera does not see.
  const auto far = session::place_of(wide, Point<WorldFrame>{{1.6, 1.0, 0.3}});
  ASSERT_TRUE(far);
  EXPECT_FALSE(session::zoomed_shift(wide, {}, near, *far, 0.002).point);
}

}  // namespace
}  // namespace palpable::study
