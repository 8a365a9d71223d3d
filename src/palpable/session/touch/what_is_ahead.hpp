// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/session/robot/robot_map.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace palpable::session {

/// What stands before a robot, by its shape alone: a wall is plane, upright, at least 1.2 m wide and higher
/// than the picture or 1.5 m; a table is 0.45 to 1.1 m high, at least 0.5 m wide and open below.
enum class ThingKind : std::uint8_t { wall, table, other };

struct ThingAhead {
  ThingKind kind = ThingKind::other;
  /// From the robot's border to its nearest part in the robot's way.
  double distance_m = 0.0;
  double width_m = 0.0;
  /// It reaches beyond the picture's left or right border.
  bool is_wider = false;
  /// Above the floor; nullopt: it reaches beyond the picture's upper border.
  std::optional<double> top_m;
};

/// The nearest thing in the way of a robot that goes straight on, up to 2.5 m; `depth` is that of its camera,
/// and must state it. nullopt: none is seen.
std::optional<ThingAhead> thing_ahead(const DepthMap& depth, const RobotShape& shape);

/// "A table, 60 cm ahead: 110 cm wide, 72 cm high."
std::string sentence_of(const ThingAhead& thing);

/// Says what is ahead of a robot that stands before something: once, and again if that is something else, or
/// elsewhere by more than a quarter.
class AheadWatch {
 public:
  /// For each picture. `stands`: the robot was started and stands, in a mode in which it moves.
  std::optional<std::string> look(double t_s, const DepthMap& depth, const RobotShape& shape, bool stands);

 private:
  std::optional<ThingAhead> said_;
  /// What the last picture showed.
  std::optional<ThingKind> seen_;
  double said_at_s_ = 0.0;
};

}  // namespace palpable::session
