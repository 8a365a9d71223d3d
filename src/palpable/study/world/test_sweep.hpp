// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/robot/wrist_sweep.hpp"
#include "palpable/study/world/near_scene.hpp"
#include "palpable/study/world/robot_world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace palpable::study {

inline Image image_of(const Raster<Rgb8>& picture) {
  Image image{picture.width(), picture.height(), 3, 8, {}};
  for (const Rgb8& pixel : picture.values())
    for (const auto channel : {pixel.r, pixel.g, pixel.b})
      image.samples.push_back(static_cast<float>(channel) / 255.0F);
  return image;
}

/// A robot before a table, whose arm is moved by a WristSweep in simulated time. Pictures come five times a
/// second, 0.1 s late.
class SweptRobot {
 public:
  /// `width`: of the pictures, px.
  explicit SweptRobot(std::uint64_t seed, int width = 160)
      : camera(camera_of(width, width * 3 / 4, 0.96)),
        world(make_near_room(seed), {}, {}, seed),
        seed_(seed) {
    world.place(near_place());
    step();
  }

  /// 20 ms.
  void step() {
    constexpr double kDelay_s = 0.1, kPicture_s = 0.2;
    world.advance(0.02);
    const double now_s = world.time_s();
    if (arm_speaks) sweep.take_pose(now_s, world.measured_base_from_wrist(), now_s);
    if (now_s >= next_s_ && sweep.is_active()) {
      next_s_ = now_s + kPicture_s;
      CameraNoise noise;
      noise.colour = 2.0;
      noise.seed = ++seed_;
      coming_.emplace_back(now_s, image_of(world.wrist_view(camera, noise).colour));
    }
    for (; !coming_.empty() && coming_.front().first <= now_s - kDelay_s; coming_.pop_front())
      sweep.take_picture(now_s, std::move(coming_.front().second), coming_.front().first);
    command_m_per_s = sweep.command(now_s, may_move);
    if (arm_obeys) world.command_arm(command_m_per_s);
    farthest_m = std::max(farthest_m, std::abs(world.base_from_wrist().translation_m.y));
  }
  /// A whole sweep, until the arm stands at home again; at most a minute.
  std::optional<std::vector<session::WristPicture>> swept() {
    if (!sweep.begin(world.time_s())) return std::nullopt;
    for (int k = 0; k < 3000 && sweep.is_active(); ++k) step();
    return sweep.take_pictures();
  }

  Pinhole camera;
  RobotWorld world;
  session::WristSweep sweep{{}};
  bool may_move = true, arm_speaks = true, arm_obeys = true;
  double command_m_per_s = 0.0, farthest_m = 0.0;

 private:
  std::uint64_t seed_;
  double next_s_ = 0.0;
  std::deque<std::pair<double, Image>> coming_;
};

}  // namespace palpable::study
