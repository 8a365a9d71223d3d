// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/servo/latency_recorder.hpp"
#include "palpable/session/robot/measured_time.hpp"
#include "palpable/session/robot/motion_watch.hpp"
#include "palpable/session/robot/robot_drive.hpp"
#include "palpable/session/robot/robot_state.hpp"
#include "palpable/session/touch/notices.hpp"
#include "palpable/session/touch/robot_hand.hpp"
#include "palpable/session/touch/touch_statistics.hpp"
#include "palpable/sources/live/rosbridge_client.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace palpable::session {

/// What a robot's thread knows when its arm is told what to do.
struct RobotNow {
  double t_s = 0.0;
  RobotMode mode = RobotMode::drive;
  bool is_started = false;
  /// A person holds the hand, and pictures, odometry and connection are there.
  bool may_move = false;
  RobotPose pose;
};

/// The wheels of a robot behind a rosbridge server: commanded by the hand (RobotDrive), and stopped with a
/// sentence when something is lost, touched, or does other than it is told. tick() and stand() by one thread,
/// the rest by any.
class RobotWheels {
 public:
  using Clock = std::chrono::steady_clock;
  /// As the robot's parts count time.
  static double seconds_of(Clock::time_point time);
  /// Places of the topics in the client's list, and of the command in its publications. `client` must outlive
  /// this.
  struct Places {
    std::size_t odometry = 0, battery = 0, contact = 0, command = 0;
  };
  RobotWheels(sources::RosbridgeClient& client, const Places& places, const DriveOptions& options,
              RobotMode mode);

  void request_start();
  void request_stop();
  void change_mode(RobotMode mode);

  /// A picture of the robot's camera, and when it was taken by the robot's clock.
  void take_picture(Clock::time_point arrival, const DepthMap& depth, std::optional<double> stamp_s);
  /// At least ten times a second: takes what came, and commands the wheels. What the arm may do now.
  RobotNow tick(Clock::time_point now, const RobotHand::Now& hand);
  /// Tells them to stand, if they were ever told to move. False: that cannot be sent now.
  bool stand();

  /// As it is now.
  RobotDrive drive() const;
  RobotMode mode() const;
  RobotPose pose() const;
  /// RobotDrive::pose_at().
  std::optional<RobotPose> pose_at(std::optional<double> stamp_s) const;
  /// Without sounds and arm.
  RobotStatistics statistics() const;
  /// As it was at the end of the last tick, without the view.
  RobotState state() const;
  /// RobotControl::floor().
  std::shared_ptr<const RobotFloor> floor() const;
  std::optional<std::string> notice() { return notices_.take(); }

 private:
  enum class Asked : std::uint8_t { nothing, start, stop };

  // With the lock.
  void report(RobotEvent event);
  RobotState state_now(double now_s) const;
  void publish_state(Clock::time_point now);
  void take_state();
  void take_contact(bool touches);
  void take_battery(double charge);
  void notice_loss(Clock::time_point now);
  void notice_stall(Clock::time_point now);
  void follow_wishes(double now_s);
  void tell(DriveLimit limit, Clock::time_point now);
  void send(const RobotVelocity& velocity, Clock::time_point now);
  void watch_motion(Clock::time_point now);

  sources::RosbridgeClient& client_;
  Places places_;
  Notices notices_;

  /// Guards what follows.
  mutable std::mutex mutex_;
  RobotDrive drive_;
  Asked asked_ = Asked::nothing;
  std::optional<double> start_asked_at_s_;
  bool has_commanded_ = false;
  bool touches_ = false;
  RobotEvent event_ = RobotEvent::none;
  std::uint64_t events_ = 0;
  std::optional<double> battery_;
  bool said_battery_ = false;
  DriveLimit limit_ = DriveLimit::none;
  /// The last one that lasted.
  DriveLimit lasting_limit_ = DriveLimit::none;
  bool limit_is_said_ = false;
  Clock::time_point limit_since_;
  std::optional<Clock::time_point> started_at_, ticked_at_;
  bool was_lost_ = false;
  std::uint64_t losses_ = 0;
  /// The command that was sent last.
  RobotVelocity published_;
  std::optional<double> odometry_stamp_s_;
  MeasuredTime measured_time_;
  MotionWatch::Measured measured_;
  MotionWatch watch_;
  RobotStatistics statistics_;
  haptics::LatencyRecorder picture_ages_;
  /// When the floor was last published.
  Clock::time_point floor_at_;

  mutable std::mutex state_mutex_;
  // Guarded by state_mutex_, which is held for a copy only.
  RobotState state_;
  std::shared_ptr<const RobotFloor> floor_;
};

}  // namespace palpable::session
