// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_robot.hpp"

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

using std::chrono::milliseconds;

TEST(PageRobot, IsToldInTheWordsOfTheProtocol) {
  session::RobotState state;
  state.is_started = true;
  state.mode = session::RobotMode::touch;
  state.view = session::RobotView::near;
  state.limit = session::DriveLimit::obstacle;
  state.lacks = session::RobotLack::picture;
  state.event = session::RobotEvent::stays;
  state.battery = 0.1;
  state.picture_age_s = 0.234;
  const auto robot = page_robot(state);
  EXPECT_TRUE(robot.started);
  EXPECT_EQ(robot.mode, "touch");
  EXPECT_EQ(robot.view, "near");
  EXPECT_EQ(robot.limit, "obstacle");
  EXPECT_EQ(robot.lacks, "picture");
  EXPECT_EQ(robot.event, "stays");
  EXPECT_TRUE(robot.low_battery);
  EXPECT_NEAR(*robot.picture_age_s, 0.2, 1e-9);
  EXPECT_FALSE(page_robot({}).view);
  EXPECT_FALSE(page_robot({}).low_battery);
}

TEST(PageRobot, ShowsTheFloorCellByCell) {
  using session::FloorCell;
  session::RobotFloor floor;
  floor.pose = {1.0, 2.0, 7.0};
  floor.cells = Raster<FloorCell>(2, 2, FloorCell::unknown);
  floor.cells(1, 0) = FloorCell::blocked;
  floor.cells(0, 1) = FloorCell::free;
  floor.ahead_ends = FloorCell::blocked;
  floor.left_m = 0.4;
  const auto shown = page_floor(floor);
  EXPECT_EQ(shown.cells, "0210");
  EXPECT_EQ(shown.side, 2);
  EXPECT_EQ(shown.ahead_ends, "blocked");
  EXPECT_NEAR(shown.heading_deg, 41.07, 0.01);
  EXPECT_EQ(shown.left_m, 0.4);
  EXPECT_FALSE(shown.right_m);
}

TEST(PageRobot, IsToldAtOnceOfAStopAndTwiceASecondOfFigures) {
  RobotNews news;
  std::chrono::steady_clock::time_point now;
  protocol::Robot robot;
  robot.picture_age_s = 0.0;
  int told = 0;
  auto shown = news.take(robot, now);
  for (int k = 1; k <= 60; ++k) {
    robot.picture_age_s = 0.1 * k;
    const auto next = news.take(robot, now + milliseconds(1000 * k / 60));
    told += next == shown ? 0 : 1;
    shown = next;
  }
  EXPECT_EQ(told, 2);
  robot.event = "stopped";
  EXPECT_EQ(news.take(robot, now + milliseconds(1001)), robot);
}

}  // namespace
}  // namespace palpable::page
