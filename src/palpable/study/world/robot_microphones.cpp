// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/robot_microphones.hpp"

#include "palpable/study/world/room_echo.hpp"
#include "palpable/study/world/sound_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::study {
namespace {

constexpr double kSpoken_s = 1.5, kPeriod_s = 4.0, kEchoes_s = 0.05, kMouth_m = 1.5;
/// Loudness 1 m away, of full scale.
constexpr double kLevel = 0.05;
constexpr std::size_t kPeriod = static_cast<std::size_t>(kPeriod_s * RobotMicrophones::kRate_hz);

double drawn_uniformly(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

/// Half a metre from the walls and outside of the furniture.
Point<WorldFrame> place_to_speak(const Room& room, std::mt19937_64& random) {
  constexpr int kTries = 10'000;
  constexpr double kWall_m = 0.5, kAround_m = 0.2;
  for (int k = 0; k < kTries; ++k) {
    const Point<WorldFrame> at{{(drawn_uniformly(random) - 0.5) * (room.size_m.x - 2.0 * kWall_m),
                                (drawn_uniformly(random) - 0.5) * (room.size_m.y - 2.0 * kWall_m), kMouth_m}};
    if (distance_m(room, at) > kAround_m) return at;
  }
  return {{0.0, 0.0, kMouth_m}};
}

}  // namespace

RobotMicrophones::RobotMicrophones(const Room& room, Microphones microphones, double height_m,
                                   std::uint64_t seed)
    : room_(room),
      microphones_(std::move(microphones)),
      height_m_(height_m),
      random_(seed),
      spoken_(test_sound(TestSound::speech, kRate_hz, kSpoken_s, seed)) {
  source_ = place_to_speak(room_, random_);
}

RobotMicrophones::Responses RobotMicrophones::responses_at(const FloorPose& pose) const {
  RoomEcho echo;
  echo.size_m = room_.size_m;
  // About 0.3 s of reverberation, of which the beginning is computed.
  echo.reflection = 0.75;
  echo.speed_of_sound_m_per_s = microphones_.speed_of_sound_m_per_s;
  const double c = std::cos(pose.heading_rad), s = std::sin(pose.heading_rad);
  Responses responses;
  for (const auto& microphone : microphones_.positions_m) {
    // Ahead is z and right is x of the array.
    const double ahead_m = microphone.v.z, right_m = microphone.v.x;
    const Point<WorldFrame> at{{pose.x_m + c * ahead_m + s * right_m, pose.y_m + s * ahead_m - c * right_m,
                                height_m_ - microphone.v.y}};
    responses.push_back(impulse_response(echo, source_, at, kRate_hz, kEchoes_s));
  }
  return responses;
}

std::vector<std::int16_t> RobotMicrophones::hear(const FloorPose& pose, std::size_t length) {
  constexpr double kMoved = 0.01;
  const bool is_moved = responses_.empty() ||
                        std::hypot(pose.x_m - heard_at_.x_m, pose.y_m - heard_at_.y_m) > kMoved ||
                        std::abs(pose.heading_rad - heard_at_.heading_rad) > kMoved;
  const Responses before = responses_;
  if (is_moved) {
    responses_ = responses_at(pose);
    heard_at_ = pose;
  }
  const auto spoken_at = [&](std::size_t time, std::size_t ago) {
    if (ago > time) return 0.0F;
    const std::size_t at = (time - ago) % kPeriod;
    return at < spoken_.size() ? spoken_[at] : 0.0F;
  };
  const auto heard = [&](const std::vector<float>& response, std::size_t time) {
    double sum = 0.0;
    for (std::size_t k = 0; k < response.size(); ++k) sum += double{response[k]} * double{spoken_at(time, k)};
    return sum;
  };
  const std::size_t channels = responses_.size();
  std::vector<std::int16_t> samples(length * channels);
  for (std::size_t k = 0; k < length; ++k, ++time_)
    for (std::size_t c = 0; c < channels; ++c) {
      double value = heard(responses_[c], time_);
      // A robot that moves hears no clicks.
      if (is_moved && !before.empty()) {
        const double share = static_cast<double>(k) / static_cast<double>(length);
        value = share * value + (1.0 - share) * heard(before[c], time_);
      }
      constexpr double kNoise = 0.05;
      const double noise = kNoise * 2.0 * (drawn_uniformly(random_) - 0.5);
      samples[channels * k + c] =
          static_cast<std::int16_t>(std::lround(32767.0 * std::clamp(kLevel * (value + noise), -1.0, 1.0)));
    }
  return samples;
}

}  // namespace palpable::study
