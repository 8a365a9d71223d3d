// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The drive of a telepresence touch and a simulated robot together, in simulated time.
#include "palpable/session/robot/robot_drive.hpp"

#include "palpable/session/robot/motion_watch.hpp"
#include "palpable/study/world/robot_world.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

using session::DriveHand;
using session::DriveLimit;
using session::RobotDrive;

session::DriveOptions options_for(const RobotBody& body) {
  session::DriveOptions options;
  options.shape = {body.radius_m, body.height_m, body.camera_height_m, body.camera_forward_m,
                   body.camera_down_rad};
  return options;
}

/// A drive and a robot that is driven by it, with pictures that come late.
class Telepresence {
 public:
  explicit Telepresence(std::uint64_t seed, double picture_delay_s = 0.1)
      : delay_s_(picture_delay_s),
        seed_(seed),
        world(make_room(seed), {}, {}, seed),
        drive(options_for(world.body())) {}

  /// One step of 20 ms.
  void step(const DriveHand& hand) {
    constexpr double kPicture_s = 0.08;
    world.advance(0.02);
    const double now_s = world.time_s();
    if (link_holds) {
      const auto& at = world.odometry();
      drive.take_odometry(now_s, {at.x_m, at.y_m, at.heading_rad}, now_s);
      if (now_s >= next_picture_s_ && camera_works) {
        next_picture_s_ = now_s + kPicture_s;
        CameraNoise noise{vision::DepthNoise{}, 0.25, 6.0, 0.0, ++seed_};
        pictures_.push_back({now_s, {world.view(camera_, noise).depth_m, camera_}});
      }
      while (!pictures_.empty() && pictures_.front().taken_s <= now_s - delay_s_) {
        drive.take_picture(now_s, pictures_.front().depth, pictures_.front().taken_s);
        pictures_.pop_front();
      }
    }
    if (hand_holds) drive.take_hand(now_s, hand);
    command = drive.command(now_s);
    watch_motion(now_s);
    if (link_holds) world.command({command.velocity.forward_m_per_s, command.velocity.turn_rad_per_s});
  }
  /// Until pictures have come, and the person starts.
  void begin() {
    for (int k = 0; k < 20; ++k) step({});
    ASSERT_TRUE(drive.start(world.time_s()));
  }

 private:
  struct Taken {
    double taken_s;
    DepthMap depth;
  };
  /// Of odometry that trembles.
  void watch_motion(double now_s) {
    session::RobotPose at{world.odometry().x_m, world.odometry().y_m, world.odometry().heading_rad};
    at.x_m += 0.002 * normal_(noise_);
    at.y_m += 0.002 * normal_(noise_);
    at.heading_rad += 0.003 * normal_(noise_);
    if (watch_.look(now_s, command.velocity, world.motion().forward_m_per_s, at, link_holds)) ++false_alarms;
  }

  double delay_s_;
  std::uint64_t seed_;
  session::MotionWatch watch_;
  std::mt19937_64 noise_{seed_};
  std::normal_distribution<double> normal_;
  Pinhole camera_ = camera_of(80, 60, 1.52);
  double next_picture_s_ = 0.0;
  std::deque<Taken> pictures_;

 public:
  RobotWorld world;
  RobotDrive drive;
  RobotDrive::Command command;
  int false_alarms = 0;
  bool link_holds = true, camera_works = true, hand_holds = true;
};

/// A person who does not look where they go: mostly ahead, for about a second each.
class Reckless {
 public:
  explicit Reckless(std::uint64_t seed) : random_(seed) {}
  DriveHand hand(double t_s) {
    if (t_s >= until_s_) {
      until_s_ = t_s + 0.3 + 1.5 * uniform();
      hand_ = {uniform() < 0.5 ? 0.0 : 2.0 * uniform() - 1.0, uniform() < 0.2 ? 0.0 : 0.5 + 0.5 * uniform()};
    }
    return hand_;
  }

 private:
  double uniform() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
  std::mt19937_64 random_;
  double until_s_ = 0.0;
  DriveHand hand_;
};

TEST(RobotDriveInRooms, TouchesNothingHoweverItIsDriven) {
  double way_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Telepresence touch(seed);
    touch.begin();
    Reckless person(seed);
    for (int k = 0; k < 500; ++k) {
      touch.step(person.hand(touch.world.time_s()));
      way_m += 0.02 * touch.world.motion().forward_m_per_s;
    }
    // The robot is told to stand, and does.
    touch.hand_holds = false;
    for (int k = 0; k < 150; ++k) touch.step({});
    EXPECT_FALSE(touch.world.has_touched()) << "room " << seed;
    EXPECT_EQ(touch.false_alarms, 0) << "room " << seed;
  }
  // It drives, too.
  EXPECT_GT(way_m, 5.0);
}

TEST(RobotDriveInRooms, CommandsZeroWithin100MsOfEachOf200CutsOfTheLink) {
  std::mt19937_64 random(7);
  Telepresence touch(3);
  touch.begin();
  Reckless person(3);
  int moving = 0;
  for (int cut = 0; cut < 200; ++cut) {
    for (int k = 0, steps = 10 + static_cast<int>(random() % 40); k < steps; ++k)
      touch.step(person.hand(touch.world.time_s()));
    moving += touch.command.velocity != session::RobotVelocity{} ? 1 : 0;
    const double cut_s = touch.world.time_s();
    touch.link_holds = false;
    while (touch.world.time_s() < cut_s + 0.12 - 1e-6) touch.step(person.hand(touch.world.time_s()));
    EXPECT_EQ(touch.command.velocity, session::RobotVelocity{}) << cut;
    EXPECT_EQ(touch.command.limit, DriveLimit::link_lost);
    touch.link_holds = true;
  }
  EXPECT_GT(moving, 50);
  EXPECT_FALSE(touch.world.has_touched());
}

}  // namespace
}  // namespace palpable::study
