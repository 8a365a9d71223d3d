// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// The drive of a telepresence touch and a simulated robot together, in simulated time.

#include "palpable/session/robot/motion_watch.hpp"
#include "palpable/session/robot/robot_drive.hpp"
#include "palpable/study/world/robot_world.hpp"

#include <cstdint>
#include <deque>
#include <random>

namespace palpable::study {

inline session::DriveOptions options_for(const RobotBody& body) {
  session::DriveOptions options;
  options.shape = {body.radius_m, body.height_m, body.camera_height_m, body.camera_forward_m,
                   body.camera_down_rad};
  return options;
}

/// A drive and a robot that is driven by it, with pictures that come late.
class Telepresence {
 public:
  explicit Telepresence(std::uint64_t seed, double picture_delay_s = 0.1)
      : delay_s_(picture_delay_s),
        seed_(seed),
        world(make_room(seed), {}, {}, seed),
        drive(options_for(world.body())) {}

  /// One step of 20 ms.
  void step(const session::DriveHand& hand) {
    constexpr double kPicture_s = 0.08;
    world.advance(0.02);
    const double now_s = world.time_s();
    if (link_holds) {
      const auto& at = world.odometry();
      drive.take_odometry(now_s, {at.x_m, at.y_m, at.heading_rad}, now_s);
      if (now_s >= next_picture_s_ && camera_works) {
        next_picture_s_ = now_s + kPicture_s;
        CameraNoise noise{vision::DepthNoise{}, 0.25, 6.0, 0.0, ++seed_};
        pictures_.push_back({now_s, {world.view(camera, noise).depth_m, camera}});
      }
      while (!pictures_.empty() && pictures_.front().taken_s <= now_s - delay_s_) {
        drive.take_picture(now_s, pictures_.front().depth, pictures_.front().taken_s);
        pictures_.pop_front();
      }
    }
    if (hand_holds) drive.take_hand(now_s, hand);
    command = drive.command(now_s);
    watch_motion(now_s);
    if (link_holds) world.command({command.velocity.forward_m_per_s, command.velocity.turn_rad_per_s});
  }
  /// Until pictures have come, and the person starts; whether that can be.
  bool begin() {
    for (int k = 0; k < 20; ++k) step({});
    return drive.start(world.time_s());
  }

 private:
  struct Taken {
    double taken_s;
    DepthMap depth;
  };
  /// Of odometry that trembles.
  void watch_motion(double now_s) {
    session::RobotPose at{world.odometry().x_m, world.odometry().y_m, world.odometry().heading_rad};
    at.x_m += 0.002 * normal_(noise_);
    at.y_m += 0.002 * normal_(noise_);
    at.heading_rad += 0.003 * normal_(noise_);
    if (watch_.look(now_s, command.velocity, {now_s, at, world.motion().forward_m_per_s}, link_holds))
      ++false_alarms;
  }

  double delay_s_;
  std::uint64_t seed_;
  session::MotionWatch watch_;
  std::mt19937_64 noise_{seed_};
  std::normal_distribution<double> normal_;
  double next_picture_s_ = 0.0;
  std::deque<Taken> pictures_;

 public:
  Pinhole camera = camera_of(80, 60, 1.52);
  RobotWorld world;
  session::RobotDrive drive;
  session::RobotDrive::Command command;
  int false_alarms = 0;
  bool link_holds = true, camera_works = true, hand_holds = true;
};

}  // namespace palpable::study
