// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/listener.hpp"

#include "palpable/hearing/spectrum.hpp"
#include "palpable/hearing/test_arrays.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace palpable::hearing {
namespace {

const Microphones kSpatial{
    {{{0.06, -0.06, 0.06}}, {{-0.06, -0.06, -0.06}}, {{0.06, 0.06, -0.06}}, {{-0.06, 0.06, 0.06}}}};
constexpr std::size_t kLength = 16'384;

/// White noise from far away, exactly delayed, 40 dB below full scale, and noise of the channels' own.
Sound far_noise(const Microphones& at, double rate_hz, std::optional<Vec3> towards, double own_level) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  std::vector<float> source(kLength);
  for (float& sample : source) sample = 0.01F * normal(random);
  const Spectrum spectrum = spectrum_of(source);
  Sound sound{rate_hz, {}};
  for (const auto& p : at.positions_m) {
    Spectrum delayed = spectrum;
    const double late_s = towards ? -dot(p.v, *towards) / at.speed_of_sound_m_per_s : 0.0;
    for (std::size_t bin = 0; bin < delayed.size(); ++bin) {
      const double hz = rate_hz * static_cast<double>(bin) / static_cast<double>(kLength);
      delayed[bin] *=
          std::polar(towards ? 1.0F : 0.0F, static_cast<float>(-2.0 * std::numbers::pi * hz * late_s));
    }
    sound.channels.push_back(samples_of(delayed));
    for (float& sample : sound.channels.back()) sample += static_cast<float>(own_level) * normal(random);
  }
  return sound;
}

TEST(Listener, FindsTheDirectionOfANoiseAtEveryRate) {
  for (const double rate_hz : {16'000.0, 44'100.0})
    for (const double azimuth_deg : {-170.0, -60.0, 0.0, 95.0}) {
      const Vec3 towards = direction_at(azimuth_deg, 25.0).v;
      auto listener = Listener::create(kSpatial, rate_hz);
      ASSERT_TRUE(listener);
      const auto windows = listener->take(far_noise(kSpatial, rate_hz, towards, 0.00316));
      ASSERT_FALSE(windows.empty());
      for (const auto& window : windows) {
        ASSERT_TRUE(window.direction) << window.confidence;
        EXPECT_LT(angle_deg(window.direction->v, towards), 1.0) << rate_hz << " Hz, " << azimuth_deg;
        EXPECT_NEAR(10.0 * std::log10(window.shared_power / window.other_power), 10.0, 1.5);
      }
    }
}

TEST(Listener, ALevelArrayGivesTheAzimuthOfASoundBelowToo) {
  const Vec3 below = direction_at(50.0, -30.0).v;
  auto listener = Listener::create(kLevelArray, 16'000.0);
  for (const auto& window : listener->take(far_noise(kLevelArray, 16'000.0, below, 0.00316))) {
    ASSERT_TRUE(window.direction);
    EXPECT_NEAR(bearing_of(*window.direction, listener->geometry().shape).azimuth_deg, 50.0, 1.0);
  }
}

TEST(Listener, SilenceAndNoiseWithoutADirectionHaveNone) {
  for (const double own_level : {0.0, 1e-6, 0.01, 0.3}) {
    auto listener = Listener::create(kLevelArray, 16'000.0);
    const auto windows = listener->take(far_noise(kLevelArray, 16'000.0, std::nullopt, own_level));
    EXPECT_EQ(windows.size(), 3U);
    for (const auto& window : windows)
      EXPECT_FALSE(window.direction) << own_level << ": " << window.confidence;
  }
}

TEST(Listener, PiecesOfAnyLengthGiveTheSameWindows) {
  const Sound whole = far_noise(kLevelArray, 16'000.0, direction_at(20.0, 0.0).v, 0.001);
  auto listener = Listener::create(kLevelArray, 16'000.0);
  const auto expected = listener->take(whole);
  auto other = Listener::create(kLevelArray, 16'000.0);
  std::vector<HeardWindow> windows;
  for (std::size_t begin = 0, step = 1; begin < kLength; begin += step, step = step * 3 % 1000 + 1) {
    Sound piece{whole.rate_hz, {}};
    for (const auto& channel : whole.channels)
      piece.channels.emplace_back(
          channel.begin() + static_cast<std::ptrdiff_t>(begin),
          channel.begin() + static_cast<std::ptrdiff_t>(std::min(kLength, begin + step)));
    for (const auto& window : other->take(piece)) windows.push_back(window);
  }
  ASSERT_EQ(windows.size(), expected.size());
  for (std::size_t n = 0; n < windows.size(); ++n) {
    EXPECT_EQ(windows[n].direction, expected[n].direction);
    EXPECT_EQ(windows[n].end_s, expected[n].end_s);
  }
}

TEST(Listener, HearsTheEndOfARecordingAndShortOnes) {
  Sound sound = far_noise(kLevelArray, 16'000.0, direction_at(20.0, 0.0).v, 0.0001);
  constexpr std::size_t kQuiet = kLength - 1600;
  for (auto& channel : sound.channels)
    for (std::size_t i = 0; i < kQuiet; ++i) channel[i] *= 1e-3F;
  auto listener = Listener::create(kLevelArray, 16'000.0);
  for (const auto& window : listener->take(sound)) EXPECT_FALSE(window.direction);
  const auto last = listener->finish();
  ASSERT_TRUE(last && last->direction);
  EXPECT_NEAR(bearing_of(*last->direction, ArrayShape::level).azimuth_deg, 20.0, 2.0);
  EXPECT_EQ(last->end_s, sound.duration_s());

  for (auto& channel : sound.channels) channel.erase(channel.begin(), channel.begin() + kQuiet);
  auto brief = Listener::create(kLevelArray, 16'000.0);
  EXPECT_TRUE(brief->take(sound).empty());
  const auto only = brief->finish();
  ASSERT_TRUE(only && only->direction);
  EXPECT_EQ(only->end_s, sound.duration_s());
  EXPECT_FALSE(Listener::create(kLevelArray, 16'000.0)->finish());
}

TEST(Listener, SamplesThatAreNoNumbersCountAsSilence) {
  Sound sound = far_noise(kLevelArray, 16'000.0, direction_at(20.0, 0.0).v, 0.001);
  sound.channels[1].assign(kLength, NAN);
  sound.channels[2][5] = INFINITY;
  auto listener = Listener::create(kLevelArray, 16'000.0);
  for (const auto& window : listener->take(sound)) EXPECT_TRUE(std::isfinite(window.confidence));
  EXPECT_FALSE(Listener::create(kLevelArray, 1'000.0));
}

}  // namespace
}  // namespace palpable::hearing
