// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/session/robot/robot_map.hpp"

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

namespace palpable::session {

/// drive: the hand's displacement is the robot's velocity. look: likewise, but the robot only turns. touch:
/// the robot stands, and the hand touches what its camera sees.
enum class RobotMode : std::uint8_t { drive, look, touch };

/// What is touched in the mode touch: what the robot's first camera sees, or what its wrist camera saw near.
enum class RobotView : std::uint8_t { wide, near };

/// A robot's velocity: forward, and turning counter-clockwise from above.
struct RobotVelocity {
  double forward_m_per_s = 0.0;
  double turn_rad_per_s = 0.0;
  bool operator==(const RobotVelocity&) const = default;
};

struct DriveOptions {
  RobotShape shape;
  /// Greatest commands; 0.05 ... 1 and 0.1 ... 2.
  double speed_m_per_s = 0.3;
  double turn_rad_per_s = 0.7;
  /// How fast commands grow; they fall at once.
  double growth_m_per_s2 = 0.5;
  double growth_rad_per_s2 = 2.0;
  /// How surely the robot brakes.
  double braking_m_per_s2 = 0.4;
  /// From a command that no longer comes to the begin of braking: the robot's own timeout, and the delay of
  /// its pictures. 0 ... 2 s.
  double reaction_s = 0.5;
  /// Kept from everything that is not known to be free: odometry drifts.
  double margin_m = 0.1;
  /// A message of odometry, or a hand that is older makes the command zero. So does a picture that is older
  /// than this and than 2.5 times what is usual between two, or than 0.4 s.
  double lost_s = 0.1;
};

/// Errors: usage for a value out of its range.
Result<void> check(const DriveOptions& options);

/// Where the hand is: right and ahead of the device's centre, each as a share of the way to the border, -1
/// ... 1.
struct DriveHand {
  double right = 0.0;
  double ahead = 0.0;
};

/// Within this share of the way to the border the hand commands nothing.
inline constexpr double kDeadZone = 0.2;

/// Why the command is zero, or less than the hand asks for.
enum class DriveLimit : std::uint8_t {
  none,
  not_started,
  released,
  off_centre,
  link_lost,
  picture_lost,
  standing,
  obstacle
};

/// From the hand's place to the robot's velocity: rate control with a dead zone, limited so that the robot
/// stops before it meets anything that its camera has not seen to be free. Times are of any steady clock, in
/// seconds. Commands go forward only: no camera looks behind. One thread; no clock, thread or connection of
/// its own.
class RobotDrive {
 public:
  explicit RobotDrive(const DriveOptions& options);

  /// A person starts; until then, and after stop(), the command is zero. Without odometry and pictures that
  /// are newer than DriveOptions::lost_s says it does not start.
  bool start(double t_s);
  /// Why it would not start now: link_lost or picture_lost.
  std::optional<DriveLimit> obstacle_to_start(double t_s) const;
  void stop() { started_ = false; }
  bool is_started() const { return started_; }
  /// The floor around the robot, from its axis, that the person vouches for at the start: the camera does not
  /// see it.
  double vouched_m() const { return vouched_m_; }
  void set_mode(RobotMode mode);
  RobotMode mode() const { return mode_; }

  /// By its odometry.
  const RobotPose& pose() const { return pose_; }
  /// When this was by the robot's clock, within the last two seconds; nullopt before any odometry.
  std::optional<RobotPose> pose_at(std::optional<double> stamp_s) const;
  /// The floor around it, as far as it was seen.
  RobotFloor floor() const { return map_.floor(pose_); }
  /// Since the newest picture that is used; nullopt: none came.
  std::optional<double> picture_age_s(double t_s) const;

  // `stamp_s`: when it was measured, by the robot's clock; nullopt: about when it arrived.
  void take_odometry(double t_s, const RobotPose& pose, std::optional<double> stamp_s);
  /// Not used without a camera, before any odometry, and half a second after the newest odometry; if less
  /// than a tenth of it is known; and if it equals the last one though the robot moved since that came, as
  /// those of a camera that hangs.
  void take_picture(double t_s, const DepthMap& depth, std::optional<double> stamp_s);
  /// The hand holds the device. Without a call for DriveOptions::lost_s it counts as released. After a start,
  /// a release or another mode it commands nothing before it has been in the dead zone.
  void take_hand(double t_s, const DriveHand& hand);
  void release_hand();
  /// The connection ended: start() is needed again.
  void lose_link() { started_ = false; }

  struct Command {
    RobotVelocity velocity;
    DriveLimit limit = DriveLimit::none;
  };
  /// The command for now. Call it at least ten times a second.
  Command command(double t_s);
  /// The greatest speed forward while turning at this rate, from what is known now.
  double allowed_m_per_s(double turn_rad_per_s, double forward_m_per_s) const;
  /// What the hand asks for, without any limit.
  RobotVelocity asked(const DriveHand& hand) const;

 private:
  bool is_old(const std::optional<double>& at_s, double t_s) const;
  bool is_picture_old(double t_s) const;
  bool is_frozen(const Raster<float>& depth_m);
  std::optional<DriveLimit> reason_to_stand(double t_s) const;
  bool is_in_dead_zone() const;

  DriveOptions options_;
  RobotMap map_;
  RobotMode mode_ = RobotMode::drive;
  bool started_ = false;
  RobotPose pose_;
  /// Of the last two seconds, by the robot's clock.
  std::deque<std::pair<double, RobotPose>> past_;
  double vouched_m_ = 0.0;
  /// Between the last pictures.
  std::deque<double> picture_intervals_s_;
  /// The last picture, and where the robot was when it came first.
  Raster<float> last_depth_m_;
  RobotPose last_depth_pose_;
  DriveHand hand_;
  /// It has been in the dead zone since the start.
  bool was_centred_ = false;
  std::optional<double> odometry_at_s_, picture_at_s_, hand_at_s_;
  RobotVelocity last_;
  double last_at_s_ = 0.0;
};

}  // namespace palpable::session
