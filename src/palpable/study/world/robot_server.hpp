// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/study/world/robot_world.hpp"

#include <cstdint>
#include <memory>

namespace palpable::study {

/// How a robot's messages reach the network.
struct RobotLink {
  /// Pictures a second.
  double rate_hz = 20.0;
  /// From a picture to its message, and how much that varies (uniformly, up to this much more).
  double delay_s = 0.0;
  double jitter_s = 0.0;
  /// The share of pictures that never arrive.
  double loss = 0.0;
};

/// What a robot sees with: a depth camera, or two cameras side by side.
enum class RobotEyes : std::uint8_t { depth, stereo };

struct RobotServerOptions {
  std::uint64_t seed = 1;
  RobotEyes eyes = RobotEyes::depth;
  RobotBody body;
  RobotErrors errors;
  RobotLink link;
  int width = 240, height = 180;
  double field_of_view_rad = 1.52;
  /// Of a structured-light camera.
  CameraNoise noise{vision::DepthNoise{}, 0.25, 6.0, 2.0, 1};
  /// The wrist camera's, and its pictures a second.
  int wrist_width = 320, wrist_height = 240;
  double wrist_field_of_view_rad = 0.96;
  double wrist_rate_hz = 5.0;
  /// Somebody speaks in the room, and four microphones on a level square with a radius of 0.1 m, about the
  /// robot's axis at the camera's height, hear it (RobotMicrophones).
  bool has_sound = true;
  /// Names of message types and members: of ROS 2, or of ROS 1.
  bool is_ros2 = true;
  /// 0: any free one, of the loopback interface.
  std::uint16_t port = 0;
};

/// A robot in a room (RobotWorld of make_room()) behind a rosbridge server on a real WebSocket, in real time,
/// on a thread of its own. Topics that it sends: /camera/depth/image_rect_raw (16UC1),
/// /camera/color/image_raw (rgb8), /camera/depth/camera_info, or, of a stereo pair,
/// /stereo/left/image_rect_color (rgb8) and /stereo/left/camera_info and the same of the right one; /odom,
/// /battery_state, /contact, /audio (S16LE, 20 parts a second), /audio_info, and of the wrist camera
/// /wrist_camera/image_raw (rgb8), /wrist_camera/camera_info and /wrist_camera/pose (PoseStamped, in the
/// robot's frame); that it takes: /cmd_vel and /arm/cmd_vel (linear.y). One client at a time.
class RobotServer {
 public:
  /// Errors: failed (the port is in use).
  static Result<std::unique_ptr<RobotServer>> start(const RobotServerOptions& options);
  ~RobotServer();
  RobotServer(const RobotServer&) = delete;
  RobotServer& operator=(const RobotServer&) = delete;

  std::uint16_t port() const;
  // Any thread.
  FloorPose pose() const;
  WheelMotion commanded() const;
  bool has_touched() const;
  /// How far its wrist camera is to the left of the middle of its way, and how fast it moves.
  double arm_m() const;
  double arm_m_per_s() const;
  /// Commands to the arm that came.
  std::uint64_t arm_commands() const;
  /// Where somebody speaks.
  Point<WorldFrame> sound_source() const;
  /// Commands that came, also those of 0.
  std::uint64_t commands() const;
  void set_link(const RobotLink& link);
  /// Ends the connection; the next one is taken.
  void hang_up();

 private:
  struct Impl;
  explicit RobotServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable::study
