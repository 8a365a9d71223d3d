// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/robot_ears.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Microphones square() { return square_array(0.1); }

/// Noise from a far place, positive to the right, as 16 bits of four channels: each channel hears it earlier
/// the nearer it is, with noise of its own. A second before it, and after, is silent.
std::vector<std::byte> noise_from(double azimuth_deg, std::uint64_t seed, double length_s = 1.0) {
  constexpr double kRate_hz = 16'000.0;
  constexpr int kFine = 16;
  const auto length = static_cast<std::size_t>(length_s * kRate_hz),
             lead = static_cast<std::size_t>(kRate_hz);
  std::mt19937_64 random(seed);
  std::vector<double> fine(kFine * (length + 200));
  // Noise of the finer rate, made smooth enough for the coarser one.
  double slow = 0.0;
  for (double& value : fine) {
    slow += 0.1 * ((static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5) - slow);
    value = slow;
  }
  std::vector<std::int16_t> samples(4 * (length + 2 * lead), 0);
  const auto microphones = square();
  for (std::size_t c = 0; c < 4; ++c) {
    const Vec3 at = microphones.positions_m[c].v;
    const double nearer_m = at.x * std::sin(azimuth_deg * kDegree) + at.z * std::cos(azimuth_deg * kDegree);
    const auto shift =
        static_cast<std::size_t>(100 * kFine + std::lround(nearer_m / 343.2 * kRate_hz * kFine));
    for (std::size_t k = 0; k < length; ++k)
      samples[4 * (lead + k) + c] = static_cast<std::int16_t>(20'000.0 * fine[kFine * k + shift] +
                                                              static_cast<double>(random() % 3U) - 1.0);
  }
  std::vector<std::byte> bytes(samples.size() * sizeof(std::int16_t));
  std::memcpy(bytes.data(), samples.data(), bytes.size());
  return bytes;
}

TEST(RobotEars, TellWhereASoundComesFromWhileTheRobotTurns) {
  for (const double azimuth_deg : {-100.0, -30.0, 0.0, 60.0, 170.0}) {
    auto ears = RobotEars::create(square(), {});
    ASSERT_TRUE(ears);
    constexpr double kHeading_rad = 0.4;
    ears->turn(10.0, kHeading_rad);
    ears->take(noise_from(azimuth_deg, 7), 10.0);
    const auto found = ears->azimuth_rad(11.0, kHeading_rad);
    ASSERT_TRUE(found) << azimuth_deg;
    EXPECT_NEAR(std::remainder(*found / kDegree - azimuth_deg, 360.0), 0.0, 3.0);
    EXPECT_EQ(ears->sounds(), 1U);
    // The robot turns to the left: the sound moves to the right.
    const auto turned = ears->azimuth_rad(11.0, kHeading_rad + 0.5);
    EXPECT_NEAR(std::remainder(*turned - *found - 0.5, 2.0 * std::numbers::pi), 0.0, 1e-9);
    EXPECT_FALSE(ears->azimuth_rad(10.0 + RobotEars::kRemembered_s + 0.1, kHeading_rad));
  }
}

TEST(RobotEars, SayASoundOnceAndAnotherOneAtOnce) {
  auto ears = RobotEars::create(square(), {});
  ASSERT_TRUE(ears);
  ears->take(noise_from(40.0, 1), 1.0);
  EXPECT_EQ(ears->words(), "A sound ahead, to the right.");
  EXPECT_EQ(ears->words(), std::nullopt);
  // The same voice after a pause.
  ears->take(noise_from(42.0, 2), 3.0);
  EXPECT_EQ(ears->words(), std::nullopt);
  ears->take(noise_from(-90.0, 3), 5.0);
  EXPECT_EQ(ears->words(), "A sound to the left.");
  EXPECT_EQ(ears->sounds(), 3U);
}

// In parts that end within instants, as a robot turns: the direction is that of when the sound came.
TEST(RobotEars, AccountForTheTurnSinceTheSoundCame) {
  auto ears = RobotEars::create(square(), {});
  ASSERT_TRUE(ears);
  const auto heading_rad = [](double time_s) { return 0.3 + 0.7 * time_s; };
  // Clockwise from straight ahead of the robot's first heading, while the robot turns to the left.
  const auto bytes = noise_from(0.0, 5);
  constexpr std::size_t kPart = 8 * 800 + 3;
  double heard_rad = 0.0;
  int heard = 0;
  for (std::size_t at = 0; at < bytes.size(); at += kPart) {
    const double now_s = static_cast<double>(std::min(at + kPart, bytes.size())) / (8.0 * 16'000.0);
    ears->turn(now_s, heading_rad(now_s));
    ears->take(std::span(bytes).subspan(at, std::min(kPart, bytes.size() - at)), now_s);
    // A sound that stays ahead of the turning robot turns with it, by half a second less.
    if (now_s < 1.6 || now_s > 1.9) continue;
    const auto azimuth_rad = ears->azimuth_rad(now_s, heading_rad(now_s));
    ASSERT_TRUE(azimuth_rad);
    heard_rad += *azimuth_rad;
    ++heard;
  }
  ASSERT_GT(heard, 2);
  EXPECT_NEAR(heard_rad / heard, 0.7 * 0.35, 0.7 * 0.15);
}

TEST(RobotEars, SayTheFirstSoundThatComesInParts) {
  auto ears = RobotEars::create(square(), {});
  ASSERT_TRUE(ears);
  const auto bytes = noise_from(-45.0, 9, 0.6);
  std::vector<std::string> said;
  for (std::size_t at = 0; at < bytes.size(); at += 6400) {
    ears->take(std::span(bytes).subspan(at, std::min<std::size_t>(6400, bytes.size() - at)),
               1e-5 * static_cast<double>(at));
    if (auto words = ears->words()) said.push_back(*words);
  }
  EXPECT_EQ(said, std::vector<std::string>{"A sound ahead, to the left."});
}

TEST(RobotEars, NoticeChannelsThatAreCopies) {
  auto ears = RobotEars::create(square(), {});
  ASSERT_TRUE(ears);
  auto bytes = noise_from(60.0, 3, 2.0);
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) std::copy_n(&bytes[at], 2, &bytes[at + 2]);
  ears->take(bytes, 5.0);
  const auto words = ears->words();
  ASSERT_TRUE(words);
  EXPECT_NE(words->find("not listened to"), std::string::npos) << *words;
  EXPECT_FALSE(ears->azimuth_rad(5.0, 0.0));
}

TEST(RobotEars, RefuseSoundOfOtherChannelsAndFormats) {
  auto ears = RobotEars::create(square(), {});
  ASSERT_TRUE(ears);
  EXPECT_EQ(ears->take_format({2, 16'000.0, "S16LE"}).error().message,
            "sends sound of 2 channels, but there are 4 microphones");
  EXPECT_FALSE(ears->take_format({4, 16'000.0, "S24_3LE"}));
  EXPECT_TRUE(ears->take_format({4, 48'000.0, "F32LE"}));
  // A part that ends within an instant, and numbers that are none.
  ears->take(std::vector<std::byte>(4 * 4 * 48'000 + 3, std::byte{0xFF}), 1.0);
  EXPECT_EQ(ears->words(), "The robot sends sound with values that are no numbers; such parts are left out.");
  EXPECT_FALSE(RobotEars::create({{{{0.1, 0.0, 0.0}}}}, {}));
}

TEST(MarkDirection, IsABandInTheCamerasPicture) {
  const Pinhole camera{100.0, 100.0, 80.0, 60.0, 160, 120};
  Raster<std::uint8_t> labels(160, 120, 0);
  mark_direction(labels, 7, camera, 0.0, std::atan(0.5));
  EXPECT_EQ(labels(130, 60), 7);
  EXPECT_EQ(labels(130, 5), 7);
  EXPECT_EQ(labels(80, 60), 0);
  EXPECT_EQ(labels(150, 60), 0);
  // Straight lines from the robot run together towards the lower edge of a camera's picture that looks down.
  Raster<std::uint8_t> tilted(160, 120, 0);
  mark_direction(tilted, 7, camera, 30.0 * kDegree, 20.0 * kDegree);
  const auto column = [&](int y) {
    int first = -1;
    for (int x = 159; x >= 0; --x)
      if (tilted(x, y) == 7) first = x;
    return first;
  };
  EXPECT_GT(column(5), column(110));
  // Behind the robot there is no picture.
  Raster<std::uint8_t> behind(160, 120, 0);
  mark_direction(behind, 7, camera, 0.0, std::numbers::pi);
  for (const auto label : behind.values()) ASSERT_EQ(label, 0);
}

}  // namespace
}  // namespace palpable::session
