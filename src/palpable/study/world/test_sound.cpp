// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/sound_random.hpp"
#include "palpable/study/world/sound_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpable::study {
namespace {

/// Two poles at a frequency, with a bandwidth.
struct Resonance {
  Resonance(double frequency_hz, double bandwidth_hz, double rate_hz) {
    const double radius = std::exp(-std::numbers::pi * bandwidth_hz / rate_hz);
    first = 2.0 * radius * std::cos(2.0 * std::numbers::pi * frequency_hz / rate_hz);
    second = -radius * radius;
  }
  double operator()(double in) {
    const double out = in + first * before + second * earlier;
    earlier = before;
    return before = out;
  }
  double first = 0.0, second = 0.0, before = 0.0, earlier = 0.0;
};

/// One syllable: pulses of a pitch that drifts, or a hiss, through formants drawn at random.
void add_syllable(std::vector<float>& out, std::size_t begin, std::size_t end, double rate_hz,
                  SoundRandom& random) {
  const bool is_hiss = random.below(4) == 0;
  double pitch_hz = random.between(90.0, 240.0);
  const double drift = random.between(-0.3, 0.3) / static_cast<double>(end - begin);
  Resonance one(is_hiss ? 3500.0 : random.between(280.0, 800.0), is_hiss ? 2000.0 : 80.0, rate_hz);
  Resonance two(random.between(900.0, 2300.0), is_hiss ? 1500.0 : 120.0, rate_hz);
  Resonance three(random.between(2400.0, 3400.0), 200.0, rate_hz);
  const double loudness = random.between(0.5, 1.0) * (is_hiss ? 0.3 : 1.0);
  std::vector<double> samples;
  double phase = 0.0, energy = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    phase += pitch_hz / rate_hz;
    pitch_hz *= 1.0 + drift;
    const double breath = 0.02 * random.normal();
    double in = is_hiss ? random.normal() : breath;
    if (phase >= 1.0) {
      phase -= 1.0;
      if (!is_hiss) in += 1.0;
    }
    const double part = static_cast<double>(i - begin) / static_cast<double>(end - begin);
    samples.push_back(std::sin(std::numbers::pi * part) * (one(in) + 0.7 * two(in) + 0.5 * three(in)));
    energy += samples.back() * samples.back();
  }
  const double gain = loudness / std::sqrt(energy / static_cast<double>(samples.size()) + 1e-12);
  for (std::size_t i = begin; i < end; ++i) out[i] += static_cast<float>(gain * samples[i - begin]);
}

std::vector<float> speech(std::size_t length, double rate_hz, SoundRandom& random) {
  std::vector<float> out(length);
  for (std::size_t begin = 0; begin < length;) {
    const std::size_t end =
        std::min(length, begin + static_cast<std::size_t>(rate_hz * random.between(0.1, 0.25)));
    if (end > begin + 1) add_syllable(out, begin, end, rate_hz, random);
    begin = end + static_cast<std::size_t>(rate_hz * random.between(0.02, 0.1));
  }
  return out;
}

std::vector<float> claps(std::size_t length, double rate_hz, SoundRandom& random) {
  std::vector<float> out(length);
  constexpr int kClaps = 3;
  for (int clap = 0; clap < kClaps; ++clap) {
    const double at = (clap + random.between(0.1, 0.4)) / kClaps;
    const auto begin = static_cast<std::size_t>(at * static_cast<double>(length));
    const double fade_s = random.between(0.004, 0.012);
    for (std::size_t i = begin; i < length; ++i)
      out[i] += static_cast<float>(random.normal() *
                                   std::exp(-static_cast<double>(i - begin) / (fade_s * rate_hz)));
  }
  return out;
}

}  // namespace

std::vector<float> test_sound(TestSound kind, double rate_hz, double length_s, std::uint64_t seed) {
  SoundRandom random(seed ^ 0x5eedU);
  const auto length = static_cast<std::size_t>(length_s * rate_hz);
  std::vector<float> out = kind == TestSound::speech  ? speech(length, rate_hz, random)
                           : kind == TestSound::noise ? falling_noise(length, random)
                                                      : claps(length, rate_hz, random);
  const auto fade = std::min(length / 2, static_cast<std::size_t>(0.01 * rate_hz));
  for (std::size_t i = 0; i < fade; ++i) {
    const float gain = static_cast<float>(i) / static_cast<float>(fade);
    out[i] *= gain;
    out[length - 1 - i] *= gain;
  }
  double energy = 0.0;
  for (const float sample : out) energy += double{sample} * double{sample};
  const auto gain = static_cast<float>(1.0 / std::sqrt(energy / static_cast<double>(length) + 1e-12));
  for (float& sample : out) sample *= gain;
  return out;
}

}  // namespace palpable::study
