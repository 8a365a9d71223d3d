// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace palpable::study {

/// Random numbers that are the same on every machine.
class SoundRandom {
 public:
  explicit SoundRandom(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * uniform(); }
  std::uint64_t below(std::uint64_t count) { return random_() % count; }
  /// Of mean 0 and variance 1 (Box & Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  double uniform() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
  std::mt19937_64 random_;
};

/// Noise whose power falls by 3 dB an octave (Kellet's filter of white noise).
inline std::vector<float> falling_noise(std::size_t length, SoundRandom& random) {
  std::vector<float> out(length);
  double a = 0.0, b = 0.0, c = 0.0;
  for (float& sample : out) {
    const double white = random.normal();
    a = 0.99765 * a + 0.0990460 * white;
    b = 0.96300 * b + 0.2965164 * white;
    c = 0.57000 * c + 1.0526913 * white;
    sample = static_cast<float>(a + b + c + 0.1848 * white);
  }
  return out;
}

}  // namespace palpable::study
