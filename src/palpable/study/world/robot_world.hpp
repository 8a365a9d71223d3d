// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/study/world/room.hpp"
#include "palpable/study/world/room_view.hpp"

#include <cstdint>
#include <random>

namespace palpable::study {

/// Where a robot stands on the floor: metres, and its heading, counter-clockwise from the world's x axis.
struct FloorPose {
  double x_m = 0.0, y_m = 0.0;
  double heading_rad = 0.0;
};

/// What a robot's wheels are asked for, or do.
struct WheelMotion {
  double forward_m_per_s = 0.0;
  double turn_rad_per_s = 0.0;
  bool operator==(const WheelMotion&) const = default;
};

/// An arm that carries a camera above a robot, and moves it sideways.
struct WristArm {
  /// The camera in the middle of its way: from the robot's axis forward, above the floor, and how far below
  /// the horizontal it looks.
  double forward_m = 0.12;
  double height_m = 0.80;
  double down_rad = 0.75;
  /// Its way to either side.
  double reach_m = 0.08;
  double max_m_per_s = 0.06;
  double m_per_s2 = 0.3;
  /// How near to its centre the camera's body reaches.
  double radius_m = 0.03;
  /// Standard deviation of its measured position.
  double error_m = 0.0001;
};

/// A robot with two driven wheels: an upright cylinder with a camera near its top.
struct RobotBody {
  double radius_m = 0.2;
  double height_m = 0.75;
  double camera_height_m = 0.7;
  /// From the axis to the camera.
  double camera_forward_m = 0.12;
  double camera_down_rad = 0.44;
  /// Its second camera, of a stereo pair, is so far to the right of the first one.
  double baseline_m = 0.12;
  double max_forward_m_per_s = 0.5;
  double max_turn_rad_per_s = 1.5;
  double forward_m_per_s2 = 0.6;
  double turn_rad_per_s2 = 3.0;
  /// Without a command for this time the wheels brake, as the drivers of robots do.
  double command_lasts_s = 0.25;
  WristArm arm;
};

/// Errors of wheels: standard deviations as shares of what a wheel turns by, drawn anew for each 0.1 s.
struct RobotErrors {
  /// Between wheel and floor: moves the robot otherwise than the wheels say.
  double slip = 0.02;
  /// Between wheel and encoder: odometry says otherwise than the wheels.
  double odometry = 0.01;
};

/// A robot in a room, in simulated time. One thread.
class RobotWorld {
 public:
  /// Stands, looking along a free direction, at a place with 0.4 m of free floor around it, if there is such
  /// a place.
  RobotWorld(Room room, const RobotBody& body, const RobotErrors& errors, std::uint64_t seed);

  /// Puts it there, at rest.
  void place(const FloorPose& pose);
  /// The arm's speed to the left; as command().
  void command_arm(double left_m_per_s);
  /// Limited to what the wheels can do. A value that is not finite is none.
  void command(const WheelMotion& wanted);
  /// Moves by this time, in steps of 5 ms. A robot that touches something stops there.
  void advance(double dt_s);

  double time_s() const { return time_s_; }
  const FloorPose& pose() const { return pose_; }
  /// What the wheels say, from (0, 0, 0).
  const FloorPose& odometry() const { return odometry_; }
  const WheelMotion& motion() const { return motion_; }
  /// What the wheels follow now; 0 once the last command is too old.
  WheelMotion commanded() const;
  /// Where the arm's camera is in the frame of the robot (x ahead, y left, z up, from the floor below its
  /// axis), and where the arm says that it is.
  Transform<WorldFrame, CameraFrame> base_from_wrist() const;
  Transform<WorldFrame, CameraFrame> measured_base_from_wrist();
  double arm_m_per_s() const { return arm_m_per_s_; }
  /// What its wrist camera sees now.
  RoomView wrist_view(const Pinhole& camera, const CameraNoise& noise) const;
  /// Where its wrist camera and its first camera are in the room.
  Transform<WorldFrame, CameraFrame> world_from_wrist() const;
  Transform<WorldFrame, CameraFrame> world_from_camera() const;
  /// Whether it ever touched anything, with its body or its arm.
  bool has_touched() const { return has_touched_; }
  const Room& room() const { return room_; }
  const RobotBody& body() const { return body_; }
  /// What its camera sees now, and the second one of its pair.
  RoomView view(const Pinhole& camera, const CameraNoise& noise) const;
  RoomView right_view(const Pinhole& camera, const CameraNoise& noise) const;

 private:
  void step(double dt_s);
  void step_arm(double dt_s);
  void draw_errors();

  Room room_;
  RobotBody body_;
  RobotErrors errors_;
  std::mt19937_64 random_;
  FloorPose pose_, odometry_;
  WheelMotion command_, motion_;
  double time_s_ = 0.0;
  double commanded_at_s_ = -1e9;
  /// To the left of the middle of its way.
  double arm_m_ = 0.0;
  double arm_m_per_s_ = 0.0, arm_command_m_per_s_ = 0.0;
  double arm_commanded_at_s_ = -1e9;
  double next_draw_s_ = 0.0;
  /// Factors of what the wheels do, of the floor and of the encoders.
  double slip_forward_ = 1.0, slip_turn_ = 1.0, odometry_forward_ = 1.0, odometry_turn_ = 1.0;
  bool has_touched_ = false;
};

}  // namespace palpable::study
