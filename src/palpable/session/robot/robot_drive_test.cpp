// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/robot_drive.hpp"

#include "palpable/session/robot/drive_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

constexpr RobotShape kShape{0.2, 0.75, 0.7, 0.1, 0.44};

/// What a camera of kShape sees of a floor that ends at a wall, `wall_m` before the robot's axis.
DepthMap floor_and_wall(double wall_m) {
  // Wide enough that the robot's top is in the picture from 0.3 m on.
  const Pinhole camera{42.0, 42.0, 39.5, 29.5, 80, 60};
  DepthMap depth{Raster<float>(camera.width, camera.height), camera};
  const double sine = std::sin(kShape.camera_down_rad), cosine = std::cos(kShape.camera_down_rad);
  for (int v = 0; v < camera.height; ++v) {
    const double below = (v - camera.cy) / camera.fy;
    const double ahead = cosine - below * sine, down = sine + below * cosine;
    const double at_wall = (wall_m - kShape.camera_forward_m) / ahead;
    const double at_floor =
        down > 0.0 ? kShape.camera_height_m / down : std::numeric_limits<double>::infinity();
    for (float& z : depth.depth_m.row(v)) z = static_cast<float>(std::min(at_wall, at_floor));
  }
  return depth;
}

DriveOptions options_of_shape() {
  DriveOptions options;
  options.shape = kShape;
  return options;
}

/// A drive that was started before a wall, at 1 s.
RobotDrive started_before(double wall_m) {
  RobotDrive drive(options_of_shape());
  drive.take_odometry(1.0, {}, 1.0);
  drive.take_picture(1.0, floor_and_wall(wall_m), 1.0);
  drive.take_hand(1.0, {});
  EXPECT_TRUE(drive.start(1.0));
  drive.take_picture(1.0, floor_and_wall(wall_m), 1.0);
  return drive;
}

/// The command after 0.7 s in which everything came in time.
RobotDrive::Command held(RobotDrive& drive, const DriveHand& hand, double wall_m) {
  RobotDrive::Command command;
  for (double t_s = 1.02; t_s < 1.7; t_s += 0.02) {
    drive.take_odometry(t_s, {}, t_s);
    drive.take_picture(t_s, floor_and_wall(wall_m), t_s);
    drive.take_hand(t_s, hand);
    command = drive.command(t_s);
  }
  return command;
}

TEST(RobotMap, IsFreeAsFarAsTheFloorIsSeen) {
  // Farther off the rows of so small a picture are more than a cell apart.
  for (const double wall_m : {0.9, 1.1}) {
    RobotMap map(kShape);
    const auto seen = floor_and_wall(wall_m);
    map.begin({}, map.nearest_floor_m(*seen.camera));
    map.add(seen, {});
    const double free_m = map.free_distance_m({}, 0.0, 0.1, 5.0);
    EXPECT_LE(free_m, wall_m - 0.3 + 0.05);
    EXPECT_GE(free_m, wall_m - 0.3 - 0.15);
    // Where it has seen nothing it does not go.
    EXPECT_LT(map.free_distance_m({0.0, 0.0, M_PI}, 0.0, 0.1, 5.0), 0.5);
  }
}

TEST(RobotMap, ShowsTheFloorAsItLiesBeforeTheRobot) {
  // Whichever way it looks.
  for (const double heading_rad : {0.0, 2.0, -1.0}) {
    RobotMap map(kShape);
    const RobotPose pose{0.3, -0.2, heading_rad};
    const auto seen = floor_and_wall(0.9);
    map.begin(pose, map.nearest_floor_m(*seen.camera));
    map.add(seen, pose);
    const RobotFloor floor = map.floor(pose);
    const int middle = floor.cells.width() / 2;
    const auto rows_ahead = [&](double m) { return middle - static_cast<int>(m / RobotMap::kCell_m); };
    EXPECT_EQ(floor.cells(middle, rows_ahead(0.6)), FloorCell::free);
    EXPECT_EQ(floor.cells(middle, rows_ahead(1.1)), FloorCell::unknown);
    int blocked = 0;
    for (int row = rows_ahead(1.0); row <= rows_ahead(0.8); ++row)
      blocked += floor.cells(middle, row) == FloorCell::blocked ? 1 : 0;
    EXPECT_GE(blocked, 1);
    EXPECT_NEAR(floor.ahead_m, 0.9 - kShape.radius_m, 0.15);
    EXPECT_EQ(floor.ahead_ends, FloorCell::blocked);
    // The wall goes on to both sides, within 45 degrees only where it is far off.
    EXPECT_GT(floor.left_m.value_or(1.0), 0.6);
    EXPECT_GT(floor.right_m.value_or(1.0), 0.6);
  }
}

TEST(RobotMap, ForgetsAnObstacleOnlyWhenItsFloorWasSeenAFewTimes) {
  RobotMap map(kShape);
  map.begin({}, map.nearest_floor_m(*floor_and_wall(0.8).camera));
  map.add(floor_and_wall(0.8), {});
  map.add(floor_and_wall(2.0), {});
  EXPECT_LT(map.free_distance_m({}, 0.0, 0.1, 5.0), 0.6);
  for (int k = 0; k < 3; ++k) map.add(floor_and_wall(2.0), {});
  EXPECT_GT(map.free_distance_m({}, 0.0, 0.1, 5.0), 0.7);
}

TEST(RobotDrive, CommandsByTheHandBeyondTheDeadZone) {
  RobotDrive drive = started_before(2.4);
  EXPECT_EQ(held(drive, {0.1, -0.15}, 2.4).velocity, RobotVelocity{});
  const auto ahead = held(drive, {0.0, 1.0}, 2.4).velocity;
  EXPECT_NEAR(ahead.forward_m_per_s, 0.3, 1e-9);
  EXPECT_EQ(ahead.turn_rad_per_s, 0.0);
  EXPECT_NEAR(held(drive, {0.6, 0.0}, 2.4).velocity.turn_rad_per_s, -0.35, 1e-9);
  // Backwards there is no camera.
  EXPECT_EQ(held(drive, {0.0, -1.0}, 2.4).velocity, RobotVelocity{});
  drive.set_mode(RobotMode::look);
  EXPECT_EQ(held(drive, {0.0, 1.0}, 2.4).velocity, RobotVelocity{});
  drive.set_mode(RobotMode::touch);
  EXPECT_EQ(held(drive, {1.0, 1.0}, 2.4).limit, DriveLimit::standing);
}

TEST(RobotDrive, GoesNoFasterThanItCanStopBeforeAWall) {
  RobotDrive near = started_before(0.5);
  const auto command = held(near, {0.0, 1.0}, 0.5);
  EXPECT_LT(command.velocity.forward_m_per_s, 0.3);
  EXPECT_EQ(command.limit, DriveLimit::obstacle);
  const double v = command.velocity.forward_m_per_s;
  EXPECT_LE(v * 0.5 + v * v / (2.0 * 0.4), 0.5 - 0.3 + 0.05);
}

TEST(RobotDrive, IsZeroBeforeTheStartAndWithoutPicturesOdometryOrHand) {
  RobotDrive drive(options_of_shape());
  EXPECT_FALSE(drive.start(0.0));
  drive.take_odometry(0.0, {}, 0.0);
  EXPECT_FALSE(drive.start(0.0)) << "no picture";
  EXPECT_EQ(drive.command(0.0).limit, DriveLimit::not_started);
  RobotDrive started = started_before(2.4);
  ASSERT_NE(held(started, {0.0, 1.0}, 2.4).velocity, RobotVelocity{});
  const auto at = [&](double t_s, bool odometry, bool picture, bool hand) {
    if (odometry) started.take_odometry(t_s, {}, t_s);
    if (picture) started.take_picture(t_s, floor_and_wall(2.4), t_s);
    if (hand) started.take_hand(t_s, {0.0, 1.0});
    const auto command = started.command(t_s);
    EXPECT_EQ(command.velocity == RobotVelocity{}, command.limit != DriveLimit::none);
    return command.limit;
  };
  EXPECT_EQ(at(2.2, true, true, true), DriveLimit::none);
  EXPECT_EQ(at(2.4, true, true, false), DriveLimit::released);
  EXPECT_EQ(at(2.6, true, false, true), DriveLimit::picture_lost);
  EXPECT_EQ(at(2.8, false, true, true), DriveLimit::link_lost);
  EXPECT_EQ(at(3.0, true, true, true), DriveLimit::none);
  EXPECT_EQ(at(3.01, true, true, true), DriveLimit::none);
  started.release_hand();
  EXPECT_EQ(at(3.02, true, true, false), DriveLimit::released);
  started.lose_link();
  EXPECT_EQ(at(3.04, true, true, true), DriveLimit::not_started);
}

TEST(RobotDrive, StandsUntilTheHandWasInTheMiddle) {
  RobotDrive drive = started_before(2.4);
  double t_s = 1.0;
  const auto limit_at = [&](const DriveHand& hand) {
    t_s += 0.02;
    drive.take_odometry(t_s, {}, t_s);
    drive.take_picture(t_s, floor_and_wall(2.4), t_s);
    drive.take_hand(t_s, hand);
    return drive.command(t_s).limit;
  };
  const auto needs_the_middle = [&] {
    for (int k = 0; k < 10; ++k) EXPECT_EQ(limit_at({0.5, 0.9}), DriveLimit::off_centre);
    EXPECT_EQ(limit_at({0.1, -0.1}), DriveLimit::none);
    EXPECT_EQ(limit_at({0.5, 0.9}), DriveLimit::none);
  };
  EXPECT_EQ(limit_at({0.5, 0.9}), DriveLimit::none);
  EXPECT_TRUE(drive.start(t_s));
  needs_the_middle();
  drive.set_mode(RobotMode::look);
  needs_the_middle();
  drive.set_mode(RobotMode::look);
  EXPECT_EQ(limit_at({0.5, 0.9}), DriveLimit::none);
  drive.release_hand();
  needs_the_middle();
}

TEST(RobotDrive, WaitsForTheNextPictureOfASlowCamera) {
  for (const double interval_s : {0.12, 0.2, 0.6}) {
    RobotDrive drive(options_of_shape());
    drive.take_hand(0.0, {});
    int stood = 0;
    double longest_s = 0.0, since_s = 0.0;
    // Then no pictures come any more.
    for (double t_s = 0.0; t_s < 6.0; t_s += 0.02) {
      drive.take_odometry(t_s, {}, t_s);
      if (t_s < 5.0 && t_s >= since_s + interval_s - 1e-9) {
        since_s = t_s;
        // Its noise makes each picture another one.
        DepthMap picture = floor_and_wall(2.4);
        picture.depth_m(0, 0) += static_cast<float>(1e-4 * t_s);
        drive.take_picture(t_s, picture, t_s);
      }
      drive.take_hand(t_s, {0.0, 1.0});
      if (!drive.is_started()) drive.start(t_s);
      const auto limit = drive.command(t_s).limit;
      if (t_s > 3.0 && t_s < 5.0) stood += limit == DriveLimit::picture_lost ? 1 : 0;
      if (limit != DriveLimit::picture_lost) longest_s = t_s - since_s;
    }
    // One of 0.6 s is too slow for driving.
    EXPECT_EQ(stood > 0, interval_s > 0.4) << interval_s;
    EXPECT_LT(longest_s, 0.42) << interval_s;
  }
}

TEST(RobotDrive, DoesNotUsePicturesThatWereTakenLongAgo) {
  RobotDrive drive = started_before(2.4);
  drive.take_odometry(3.0, {}, 3.0);
  drive.take_hand(3.0, {0.0, 1.0});
  drive.take_picture(3.0, floor_and_wall(2.4), 2.0);
  EXPECT_EQ(drive.command(3.0).limit, DriveLimit::picture_lost);
}

TEST(RobotDrive, DoesNotTakeAPictureThatStandsStillForOne) {
  RobotDrive drive = started_before(2.4);
  ASSERT_GT(held(drive, {0.0, 1.0}, 2.4).velocity.forward_m_per_s, 0.2);
  // The same picture is sent again and again while the robot goes on.
  RobotDrive::Command command;
  double x_m = 0.0;
  for (double t_s = 1.72; t_s < 2.2; t_s += 0.02) {
    drive.take_odometry(t_s, {x_m, 0.0, 0.0}, t_s);
    drive.take_picture(t_s, floor_and_wall(2.4), t_s);
    drive.take_hand(t_s, {0.0, 1.0});
    command = drive.command(t_s);
    x_m += 0.02 * command.velocity.forward_m_per_s;
  }
  EXPECT_EQ(command.limit, DriveLimit::picture_lost);
  EXPECT_LT(x_m, 0.07);
}

TEST(RobotDrive, StandsWhereItsCameraSeesNothing) {
  RobotDrive drive = started_before(2.4);
  ASSERT_GT(held(drive, {0.0, 1.0}, 2.4).velocity.forward_m_per_s, 0.2);
  DepthMap nothing = floor_and_wall(2.4);
  for (float& z : nothing.depth_m.values()) z = kUnknownDepth;
  drive.take_odometry(1.9, {}, 1.9);
  drive.take_picture(1.9, nothing, 1.9);
  drive.take_hand(1.9, {0.0, 1.0});
  EXPECT_EQ(drive.command(1.9).limit, DriveLimit::picture_lost);
}

TEST(DriveSurface, IsABowlThatRisesTowardsAnObstacle) {
  const auto like = models::Relief::from_samples(Raster<float>(80, 60, 0.0F), 0.1 / 80);
  ASSERT_TRUE(like);
  RobotDrive far = started_before(2.4), near = started_before(0.35);
  held(far, {}, 2.4);
  held(near, {}, 0.35);
  const auto open = drive_surface(far, *like), blocked = drive_surface(near, *like);
  ASSERT_TRUE(open && blocked);
  EXPECT_NEAR((*open)->size_x_m(), like->size_x_m(), 1e-12);
  EXPECT_NEAR((*open)->size_y_m(), like->size_y_m(), 1e-12);
  const auto slope = [](const auto& surface, double x_m, double y_m) {
    return surface->sample(x_m, y_m).dzdy;
  };
  EXPECT_NEAR(slope(*open, 0.0, 0.0), 0.0, 0.05);
  const double home = slope(*open, 0.0, 0.03), held_off = slope(*blocked, 0.0, 0.03);
  EXPECT_GT(home, 0.4);
  EXPECT_LT(home, 1.2);
  EXPECT_GT(held_off, home + 0.2);
  EXPECT_LT(held_off, 3.1);
  EXPECT_NEAR(slope(*blocked, 0.0, -0.03), slope(*open, 0.0, -0.03), 0.01);
}

}  // namespace
}  // namespace palpable::session
