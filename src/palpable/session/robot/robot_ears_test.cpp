// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/robot_ears.hpp"

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Microphones square() { return square_array(0.1); }

/// Noise from a far place, positive to the right, as 16 bits of four channels: each channel hears it earlier
/// the nearer it is. A second before it, and after, is silent.
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
      samples[4 * (lead + k) + c] = static_cast<std::int16_t>(20'000.0 * fine[kFine * k + shift]);
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
    ears->take(noise_from(azimuth_deg, 7), 10.0, kHeading_rad);
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
  ears->take(noise_from(40.0, 1), 1.0, 0.0);
  EXPECT_EQ(ears->words(), "A sound ahead, to the right.");
  EXPECT_EQ(ears->words(), std::nullopt);
  // The same voice after a pause.
  ears->take(noise_from(42.0, 2), 3.0, 0.0);
  EXPECT_EQ(ears->words(), std::nullopt);
  ears->take(noise_from(-90.0, 3), 5.0, 0.0);
  EXPECT_EQ(ears->words(), "A sound to the left.");
  EXPECT_EQ(ears->sounds(), 3U);
}

TEST(RobotEars, RefuseSoundOfOtherChannelsAndFormats) {
  auto ears = RobotEars::create(square(), {});
  ASSERT_TRUE(ears);
  EXPECT_EQ(ears->take_format({2, 16'000.0, "S16LE"}).error().message,
            "sends sound of 2 channels, but there are 4 microphones");
  EXPECT_FALSE(ears->take_format({4, 16'000.0, "S24_3LE"}));
  EXPECT_TRUE(ears->take_format({4, 48'000.0, "F32LE"}));
  // A part that ends within an instant, and numbers that are none.
  ears->take(std::vector<std::byte>(4 * 4 * 48'000 + 3, std::byte{0xFF}), 1.0, 0.0);
  EXPECT_EQ(ears->words(), std::nullopt);
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
