// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/motion_watch.hpp"

#include <functional>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

struct WatchedRobot {
  RobotVelocity told;
  double measured_m_per_s;
  RobotPose pose;
  bool is_followed = true;
};

/// The quarters of a second of 10 s at which a sentence with these words was said.
std::string said_at(std::string_view words, const std::function<WatchedRobot(double)>& robot_at) {
  MotionWatch watch;
  std::string times;
  for (int k = 0; k <= 40; ++k) {
    const auto [told, measured_m_per_s, pose, is_followed] = robot_at(0.25 * k);
    const auto sentence = watch.look(0.25 * k, told, measured_m_per_s, pose, is_followed);
    if (sentence && sentence->find(words) != std::string_view::npos) times += std::to_string(k) + " ";
  }
  return times;
}

constexpr RobotVelocity kAhead{0.2, 0.0};
constexpr std::string_view kUnasked = "emergency stop", kStays = "odometry says that it stands";

TEST(MotionWatch, StopsARobotWhoseOdometryStandsThoughItIsToldToMove) {
  EXPECT_EQ(said_at(kStays, [](double) { return WatchedRobot{kAhead, 0.0, {}}; }), "9 18 27 36 ");
  // Only a blocked wheel turns it.
  EXPECT_EQ(said_at(kStays, [](double t) { return WatchedRobot{kAhead, 0.2, {0.0, 0.0, 0.1 * t}}; }), "");
  EXPECT_EQ(said_at(kStays, [](double t) { return WatchedRobot{kAhead, 0.2, {0.0, 0.01 * t, 3.0}}; }), "");
  EXPECT_EQ(said_at(kStays, [](double) { return WatchedRobot{{0.04, 0.0}, 0.0, {}}; }), "");
  EXPECT_EQ(said_at(kStays, [](double) { return WatchedRobot{kAhead, 0.0, {}, false}; }), "");
  EXPECT_EQ(said_at(kStays,
                    [](double t) {
                      return WatchedRobot{t < 5.0 ? RobotVelocity{} : kAhead, 0.0, {}};
                    }),
            "28 37 ");
}

TEST(MotionWatch, SaysOnceThatARobotMovesThoughItIsToldToStand) {
  EXPECT_EQ(said_at(kUnasked, [](double t) { return WatchedRobot{{}, 0.2, {0.2 * t, 0.0, 0.0}}; }), "7 ");
  EXPECT_EQ(said_at(kUnasked, [](double) { return WatchedRobot{{}, 0.02, {}}; }), "");
  EXPECT_EQ(said_at(kUnasked, [](double) { return WatchedRobot{{}, 0.2, {}, false}; }), "");
}

}  // namespace
}  // namespace palpable::session
