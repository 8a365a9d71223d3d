// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A robot's microphones and its ears together.
#include "palpable/study/world/robot_microphones.hpp"

#include "palpable/session/robot/robot_ears.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

/// The error of the direction in which a robot hears the speaker of its room, degrees; nullopt: it heard
/// none.
std::optional<double> error_deg(std::uint64_t seed) {
  const RobotBody body;
  const RobotWorld world(make_room(seed), body, {}, seed);
  RobotMicrophones microphones(world.room(), square_array(0.1), body.camera_height_m, seed);
  auto ears = session::RobotEars::create(square_array(0.1), {});
  const FloorPose pose = world.pose();
  const Vec3 from = microphones.source().v;
  const double truth_rad = pose.heading_rad - std::atan2(from.y - pose.y_m, from.x - pose.x_m);
  for (int k = 0; k < 40; ++k) {
    const auto part = microphones.hear(pose, 800);
    ears->turn(0.05 * k, pose.heading_rad);
    ears->take(std::as_bytes(std::span(part)), 0.05 * k);
  }
  const auto found = ears->azimuth_rad(2.0, pose.heading_rad);
  if (!found) return std::nullopt;
  return std::abs(std::remainder(*found - truth_rad, 2.0 * std::numbers::pi)) * 180.0 / std::numbers::pi;
}

TEST(RobotMicrophones, TellARobotWhereSomebodySpeaks) {
  std::vector<double> errors_deg;
  int unheard = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto error = error_deg(seed);
    if (error) errors_deg.push_back(*error);
    unheard += error ? 0 : 1;
  }
  std::sort(errors_deg.begin(), errors_deg.end());
  EXPECT_LE(unheard, 2);
  ASSERT_FALSE(errors_deg.empty());
  EXPECT_LT(errors_deg[errors_deg.size() / 2], 5.0);
}

}  // namespace
}  // namespace palpable::study
