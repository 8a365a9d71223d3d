// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/sound/microphones.hpp"
#include "palpable/study/world/robot_world.hpp"

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace palpable::study {

/// What the microphones of a robot hear: somebody who speaks for 1.5 s in every 4 s at one place of the room,
/// its first echoes of the walls (image sources within 50 ms; the furniture is not heard), and noise 25 dB
/// below it. One thread.
class RobotMicrophones {
 public:
  /// `microphones`: around a point `height_m` above the floor on the robot's axis, level, z ahead.
  RobotMicrophones(const Room& room, Microphones microphones, double height_m, std::uint64_t seed);

  /// The next `length` instants, heard where the robot stands now: 16 bits, the channels of each instant one
  /// after another.
  std::vector<std::int16_t> hear(const FloorPose& pose, std::size_t length);
  /// Where it is spoken, in the room's frame.
  Point<WorldFrame> source() const { return source_; }

  static constexpr int kRate_hz = 16'000;

 private:
  using Responses = std::vector<std::vector<float>>;
  Responses responses_at(const FloorPose& pose) const;

  Room room_;
  Microphones microphones_;
  double height_m_;
  Point<WorldFrame> source_;
  std::mt19937_64 random_;
  std::vector<float> spoken_;
  /// Instants since the begin.
  std::size_t time_ = 0;
  FloorPose heard_at_;
  Responses responses_;
};

}  // namespace palpable::study
