// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/raster.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace palpable::session {

/// Where a robot is in the frame of its odometry: metres, radians (counter-clockwise from above).
struct RobotPose {
  double x_m = 0.0, y_m = 0.0;
  double heading_rad = 0.0;
};

/// `from`, moved along a circular arc.
RobotPose moved_along(const RobotPose& from, double forward_m, double turn_rad);

/// A robot's size, as an upright cylinder around its axis of turning, and where its depth camera is.
struct RobotShape {
  double radius_m = 0.25;
  double height_m = 0.8;
  double camera_height_m = 0.7;
  /// From the axis forward.
  double camera_forward_m = 0.1;
  /// How far the camera's axis is tilted below the horizontal, radians.
  double camera_down_rad = 0.44;
  /// From the axis to the left: of the left one of a stereo camera.
  double camera_left_m = 0.0;
};

/// What is known of a piece of floor.
enum class FloorCell : std::uint8_t { unknown, free, blocked };

/// The floor around a robot, for people: as it lies before the robot, whichever way that looks.
struct RobotFloor {
  /// By odometry.
  RobotPose pose;
  RobotShape shape;
  /// A square of cells of RobotMap::kCell_m, the robot's axis in its middle: ahead is up, left is left.
  Raster<FloorCell> cells;
  /// From the robot's border: how far it could go straight on, and whether what ends that is blocked, or not
  /// known; at most kFloorSeen_m, where neither is said.
  double ahead_m = 0.0;
  FloorCell ahead_ends = FloorCell::free;
  /// From its border to the nearest blocked cell to the left, and to the right: within 45 degrees of that
  /// direction, in this square. nullopt: none is known.
  std::optional<double> left_m, right_m;
};
inline constexpr double kFloorSeen_m = 2.5;

/// What a robot has seen of the floor around it: cells of 5 cm in the frame of its odometry, each free,
/// blocked or unknown. A cell is free only where the floor itself was seen, with the whole height of the
/// robot in the camera's field of view above it; what was not seen is not free. Remembers a square of 6.4 m
/// around the newest picture. One thread.
class RobotMap {
 public:
  explicit RobotMap(const RobotShape& shape);

  /// Forgets everything but that the floor within `free_m` of the robot is free, which somebody vouches for.
  void begin(const RobotPose& pose, double free_m);
  /// `depth` must have a camera.
  void add(const DepthMap& depth, const RobotPose& pose);

  /// From the robot's axis to the nearest floor that the camera sees: what is nearer must be known otherwise.
  double nearest_floor_m(const Pinhole& camera) const;

  /// How far the robot can go along the arc (radians per metre, counter-clockwise; any finite value) until it
  /// comes nearer than `margin_m` to something that is not free, at most `longest_m`. What is nearer already
  /// does not count if the arc leads away from it.
  double free_distance_m(const RobotPose& pose, double turn_per_m, double margin_m, double longest_m) const;

  static constexpr double kCell_m = 0.05;
  /// As it is seen from this pose.
  RobotFloor floor(const RobotPose& pose) const;

 private:
  using Cell = FloorCell;
  struct Entry {
    std::int32_t x = 0, y = 0;
    Cell cell = Cell::unknown;
    /// Pictures that showed the floor of a blocked cell since something was seen there.
    std::uint8_t cleared = 0;
  };
  struct Place {
    std::int32_t x = 0, y = 0;
  };
  /// What one picture shows of a cell.
  struct Seen {
    bool floor = false;
    bool obstacle = false;
  };

  static Place place_of(double x_m, double y_m);
  Entry& entry(const Place& place);
  Cell cell(const Place& place) const;
  void take(const Place& place, const Seen& seen);

  RobotShape shape_;
  std::vector<Entry> entries_;
  std::vector<Seen> seen_;
};

}  // namespace palpable::session
