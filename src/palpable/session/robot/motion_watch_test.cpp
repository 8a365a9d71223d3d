// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/motion_watch.hpp"

#include "palpable/session/robot/measured_time.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

struct WatchedRobot {
  RobotVelocity told;
  double measured_m_per_s;
  RobotPose pose;
  bool is_followed = true;
};

/// The quarters of a second of 10 s at which this event was.
std::string said_at(RobotEvent event, const std::function<WatchedRobot(double)>& robot_at) {
  MotionWatch watch;
  std::string times;
  for (int k = 0; k <= 40; ++k) {
    const auto [told, measured_m_per_s, pose, is_followed] = robot_at(0.25 * k);
    if (watch.look(0.25 * k, told, {0.25 * k, pose, measured_m_per_s}, is_followed) == event)
      times += std::to_string(k) + " ";
  }
  return times;
}

constexpr RobotVelocity kAhead{0.2, 0.0};
constexpr auto kUnasked = RobotEvent::moved_unasked, kStays = RobotEvent::stays;

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

TEST(MotionWatch, SaysItAgainWhenTheRobotHasStoodMeanwhile) {
  EXPECT_EQ(said_at(kUnasked,
                    [](double t) {
                      const bool moves = t < 3.0 || t > 6.0;
                      return WatchedRobot{{}, moves ? 0.2 : 0.0, {}};
                    }),
            "7 31 ");
}

/// When a robot that stands, whose speed says 0 and whose odometry is read `rate_hz` times a second, is said
/// to move unasked, within 20 s; NaN: not at all. Its noise has these standard deviations.
double noticed_at_s(double rate_hz, double noise_m, double noise_rad,
                    const std::function<RobotPose(double)>& pose_at) {
  MotionWatch watch;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  RobotPose pose;
  double next_s = 0.0, measured_s = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    const double t_s = 0.02 * k;
    if (t_s >= next_s) {
      next_s += 1.0 / rate_hz;
      measured_s = t_s;
      pose = pose_at(t_s);
      pose.x_m += noise_m * normal(random);
      pose.y_m += noise_m * normal(random);
      pose.heading_rad += noise_rad * normal(random);
    }
    if (watch.look(t_s, {}, {measured_s, pose, 0.0}, true)) return t_s;
  }
  return NAN;
}

TEST(MotionWatch, NoticesAPoseThatMovesThoughTheSpeedSaysZeroWithinASecond) {
  constexpr double kBegin_s = 5.0;
  const auto since = [](double t_s) { return std::max(0.0, t_s - kBegin_s); };
  for (const double rate_hz : {50.0, 20.0, 10.0}) {
    for (const double m_per_s : {0.05, 0.3, -0.1}) {
      const double at_s = noticed_at_s(rate_hz, 0.001, 0.002, [&](double t) {
        return RobotPose{m_per_s * since(t), 0.0, 0.0};
      });
      EXPECT_LE(at_s, kBegin_s + 1.0) << rate_hz << " Hz, " << m_per_s << " m/s";
      EXPECT_GT(at_s, kBegin_s);
    }
    const double at_s = noticed_at_s(rate_hz, 0.001, 0.002, [&](double t) {
      return RobotPose{0.0, 0.0, 3.0 + 0.1 * since(t)};
    });
    EXPECT_LE(at_s, kBegin_s + 1.0) << rate_hz << " Hz, turning";
    EXPECT_GT(at_s, kBegin_s);
  }
}

TEST(MotionWatch, TakesNoNoiseNoDriftAndNoCorrectionOfAPoseForAMovement) {
  for (const double rate_hz : {50.0, 20.0, 10.0}) {
    EXPECT_TRUE(std::isnan(noticed_at_s(rate_hz, 0.003, 0.005, [](double) { return RobotPose{}; })));
    EXPECT_TRUE(std::isnan(noticed_at_s(rate_hz, 0.001, 0.002, [](double t) {
      return RobotPose{0.002 * t, 0.0, 0.002 * t};
    })));
    EXPECT_TRUE(std::isnan(noticed_at_s(rate_hz, 0.001, 0.002, [](double t) {
      return t < 5.0 ? RobotPose{} : RobotPose{0.3, 0.1, 0.4};
    })));
  }
  // It brakes for 1.3 s.
  EXPECT_TRUE(std::isnan(noticed_at_s(50.0, 0.001, 0.002, [](double t) {
    const double left_s = std::max(0.0, 1.3 - t);
    return RobotPose{-0.2 * left_s * left_s, 0.0, 0.0};
  })));
}

/// When a robot that is told to stand at 2 s, and brakes within 0.5 s, is said to move unasked, if its
/// odometry begins to come `late_s` late at 1 s; NaN: not at all within 10 s. `creeps_m_per_s`: it goes on
/// so.
double noticed_when_late_s(double late_s, double creeps_m_per_s) {
  constexpr double kStop_s = 2.0, kBraked_s = 2.5, kSpeed_m_per_s = 0.3;
  MotionWatch watch;
  MeasuredTime time;
  MotionWatch::Measured measured;
  // By a clock of its own.
  constexpr double kBooted_s = 1000.0;
  for (int k = 0; k <= 500; ++k) {
    const double t_s = 0.02 * k, taken_s = t_s > 1.0 ? std::max(1.0, t_s - late_s) : t_s;
    const bool stands = taken_s > kBraked_s;
    measured = {
        time.of(t_s, taken_s + kBooted_s),
        {kSpeed_m_per_s * std::min(taken_s, kBraked_s) + creeps_m_per_s * std::max(0.0, taken_s - kBraked_s),
         0.0, 0.0},
        stands ? creeps_m_per_s : kSpeed_m_per_s};
    const RobotVelocity told = t_s < kStop_s ? kAhead : RobotVelocity{};
    if (watch.look(t_s, told, measured, true) == kUnasked) return t_s;
  }
  return NAN;
}

TEST(MotionWatch, TakesNoOdometryThatComesLateForAMovement) {
  for (const double late_s : {0.0, 0.5, 1.2, 1.9}) {
    EXPECT_TRUE(std::isnan(noticed_when_late_s(late_s, 0.0))) << late_s;
    // As soon as the odometry of a second and a half after the stop has come.
    EXPECT_NEAR(noticed_when_late_s(late_s, 0.2), 2.0 + 1.5 + late_s, 0.1) << late_s;
  }
}

TEST(MeasuredTime, IsThatOfTheQuickestMessageAndTheRobotsClock) {
  MeasuredTime time;
  EXPECT_EQ(time.of(10.0, std::nullopt), 10.0);
  EXPECT_NEAR(time.of(10.0, 500.0), 10.0, 1e-9);
  EXPECT_NEAR(time.of(11.7, 501.0), 11.0, 1e-9);
  EXPECT_NEAR(time.of(11.8, 501.8), 11.8, 1e-9);
  // A clock that was set back is no delay of an hour, and none at all after five seconds.
  EXPECT_NEAR(time.of(12.0, 2.0), 10.0, 1e-9);
  EXPECT_NEAR(time.of(17.0, 7.0), 17.0, 1e-9);
}

}  // namespace
}  // namespace palpable::session
