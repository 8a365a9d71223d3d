// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/robot/robot_drive.hpp"

#include <cstdint>
#include <optional>

namespace palpable::session {

/// What happened last to a robot's start and stop.
enum class RobotEvent : std::uint8_t {
  none,
  started,
  /// A start was asked for, and its odometry or its pictures did not come.
  not_ready,
  /// By a person.
  stopped,
  touched,
  link_lost,
  odometry_lost,
  picture_lost,
  /// This program stood still.
  stalled,
  /// It moves though it is told to stand.
  moved_unasked,
  /// Its odometry stands though it is told to move.
  stays
};

/// What is missing for a start.
enum class RobotLack : std::uint8_t { nothing, link, odometry, picture };

/// A robot as a person is told of it.
struct RobotState {
  bool is_started = false;
  /// A start was asked for and is waited for.
  bool is_starting = false;
  /// It is told to move.
  bool moves = false;
  RobotMode mode = RobotMode::drive;
  /// What is touched in the mode touch, or will be once the arm was swept; nullopt: it has no arm.
  std::optional<RobotView> view = {};
  /// What has limited its command for at least half a second.
  DriveLimit limit = DriveLimit::none;
  RobotLack lacks = RobotLack::link;
  RobotEvent event = RobotEvent::none;
  /// Events so far.
  std::uint64_t events = 0;
  /// RobotDrive::vouched_m().
  double vouched_m = 0.0;
  /// Share of its charge, if it is stated.
  std::optional<double> battery = {};
  /// Since the arrival of the newest picture that is used; nullopt: none came.
  std::optional<double> picture_age_s = {};
};

/// Below this share of its charge a robot's battery is low.
inline constexpr double kLowBattery = 0.15;

}  // namespace palpable::session
