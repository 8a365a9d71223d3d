// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/study/world/room.hpp"

#include <vector>

namespace palpable::study {

/// A robot on the floor: metres, and counter-clockwise from the world's x axis.
struct PlanarPose {
  double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;
};

struct DriveOptions {
  /// Of the disc that the robot keeps free of everything.
  double radius_m = 0.3;
  double speed_m_per_s = 0.4;
  double turn_rad_per_s = 0.8;
  double rate_hz = 10.0;
};

/// One drive round the room near its walls, in poses `rate_hz` apart, that touches nothing: forwards along a
/// path of free places of a 5 cm grid, turning on the spot where the path does. Empty if the room is too
/// full.
std::vector<PlanarPose> drive_round(const Room& room, const DriveOptions& options = {});

/// Errors of wheel odometry: each drive has its own scales, and each step adds to that.
struct WheelNoise {
  /// Standard deviation of the scale of distances and of turns.
  double distance_scale = 0.03;
  double turn_scale = 0.03;
  /// Random walk.
  double m_per_root_m = 0.02;
  double rad_per_root_m = 0.02;
  double rad_per_root_rad = 0.02;
};

/// What odometry says of a drive; its first pose is right.
std::vector<PlanarPose> odometry_of(const std::vector<PlanarPose>& drive, const WheelNoise& noise,
                                    std::uint64_t seed);

}  // namespace palpable::study
