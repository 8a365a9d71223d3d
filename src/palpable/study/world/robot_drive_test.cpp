// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The drive of a telepresence touch and a simulated robot together, in simulated time.
#include "palpable/session/robot/robot_drive.hpp"

#include "palpable/study/world/test_person.hpp"
#include "palpable/study/world/test_telepresence.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

using session::DriveHand;
using session::DriveLimit;

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
    ASSERT_TRUE(touch.begin());
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
  ASSERT_TRUE(touch.begin());
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

TEST(RobotDriveInRooms, LetsAPersonReachAndTouchFurniture) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Visit visit = visit_in_room(seed);
    EXPECT_TRUE(visit.has_arrived) << "room " << seed << ", " << visit.object;
    EXPECT_TRUE(visit.has_touched) << "room " << seed << ", " << visit.object;
    EXPECT_FALSE(visit.robot_touched) << "room " << seed;
  }
}

}  // namespace
}  // namespace palpable::study
