// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_robot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace palpable::page {
namespace {

using session::RobotState;

// In the order of their enumerations.
constexpr std::array kModes{"drive", "look", "touch"};
constexpr std::array kViews{"wide", "near"};
constexpr std::array kLimits{"none",      "not_started",  "released", "off_centre",
                             "link_lost", "picture_lost", "standing", "obstacle"};
constexpr std::array kLacks{"nothing", "link", "odometry", "picture"};
constexpr std::array kEvents{"none",    "started",       "not_ready",     "stopped",
                             "touched", "link_lost",     "odometry_lost", "picture_lost",
                             "stalled", "moved_unasked", "stays"};

constexpr std::array kEnds{"unknown", "free", "blocked"};
constexpr std::array kCells{'0', '1', '2'};

template <class Names, class Value>
std::string named(const Names& names, Value value) {
  return names.at(static_cast<std::size_t>(value));
}

/// A tenth of a second is as much as a person needs.
double readable_age_s(double age_s) { return 0.1 * std::min(std::round(10.0 * age_s), 1e7); }

}  // namespace

protocol::Robot page_robot(const RobotState& state) {
  protocol::Robot robot;
  robot.started = state.is_started;
  robot.starting = state.is_starting;
  robot.moving = state.moves;
  robot.mode = named(kModes, state.mode);
  if (state.view) robot.view = named(kViews, *state.view);
  robot.limit = named(kLimits, state.limit);
  robot.lacks = named(kLacks, state.lacks);
  robot.event = named(kEvents, state.event);
  robot.events = static_cast<std::int64_t>(state.events);
  robot.vouched_m = state.vouched_m;
  robot.battery = state.battery;
  robot.low_battery = state.battery && *state.battery < session::kLowBattery;
  if (state.picture_age_s) robot.picture_age_s = readable_age_s(*state.picture_age_s);
  return robot;
}

protocol::RobotFloor page_floor(const session::RobotFloor& floor) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  protocol::RobotFloor shown;
  shown.x_m = floor.pose.x_m;
  shown.y_m = floor.pose.y_m;
  shown.heading_deg = std::remainder(floor.pose.heading_rad, 2.0 * std::numbers::pi) / kDegree;
  shown.radius_m = floor.shape.radius_m;
  shown.cell_m = session::RobotMap::kCell_m;
  shown.side = floor.cells.width();
  for (const auto cell : floor.cells.values())
    shown.cells.push_back(kCells.at(static_cast<std::size_t>(cell)));
  shown.ahead_m = floor.ahead_m;
  shown.ahead_ends = named(kEnds, floor.ahead_ends);
  shown.left_m = floor.left_m;
  shown.right_m = floor.right_m;
  return shown;
}

const protocol::Robot& RobotNews::take(const protocol::Robot& newest,
                                       std::chrono::steady_clock::time_point now) {
  constexpr auto kFigures = std::chrono::milliseconds(500);
  if (shown_) {
    protocol::Robot same = newest;
    same.battery = shown_->battery;
    same.picture_age_s = shown_->picture_age_s;
    if (same == *shown_ && now - shown_at_ < kFigures) return *shown_;
  }
  shown_at_ = now;
  return shown_.emplace(newest);
}

}  // namespace palpable::page
