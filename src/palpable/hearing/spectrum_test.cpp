// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/spectrum.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::hearing {
namespace {

TEST(Spectrum, OfACosineIsItsBin) {
  std::vector<float> wave(32);
  for (std::size_t i = 0; i < wave.size(); ++i)
    wave[i] =
        static_cast<float>(std::cos(2.0 * std::numbers::pi * 3.0 * static_cast<double>(i) / 32.0 + 0.5));
  const Spectrum spectrum = spectrum_of(wave);
  ASSERT_EQ(spectrum.size(), 17U);
  for (std::size_t bin = 0; bin < spectrum.size(); ++bin)
    EXPECT_NEAR(std::abs(spectrum[bin]), bin == 3 ? 16.0 : 0.0, 1e-4) << bin;
  EXPECT_NEAR(std::arg(spectrum[3]), 0.5, 1e-5);
  const std::vector<float> back = samples_of(spectrum);
  ASSERT_EQ(back.size(), wave.size());
  for (std::size_t i = 0; i < wave.size(); ++i) EXPECT_NEAR(back[i], wave[i], 1e-5);
}

TEST(Spectrum, ConvolutionIsLinear) {
  const std::vector<float> a{1, 2, 3}, b{0, 1, 0.5F, -1};
  const std::vector<float> expected{0, 1, 2.5F, 3, -0.5F, -3};
  const std::vector<float> made = convolved(a, b);
  ASSERT_EQ(made.size(), expected.size());
  for (std::size_t i = 0; i < made.size(); ++i) EXPECT_NEAR(made[i], expected[i], 1e-5);
}

}  // namespace
}  // namespace palpable::hearing
