// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/label_expansion.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

GridEnergy noisy_energy(int width, int height, int labels, float smoothness) {
  GridEnergy energy;
  energy.width = width;
  energy.height = height;
  energy.labels = labels;
  energy.data.resize(static_cast<std::size_t>(width * height * labels));
  std::uint32_t state = 12345;
  for (auto& cost : energy.data) {
    state = state * 1664525U + 1013904223U;
    cost = static_cast<std::uint8_t>(state >> 26U);
  }
  energy.right = energy.down = Raster<float>(width, height, smoothness);
  energy.down_right = energy.down_left = Raster<float>(width, height, 0.7F * smoothness);
  return energy;
}

Candidates everywhere(const GridEnergy& energy) {
  Candidates all(energy.width, energy.height, energy.labels);
  std::fill(all.flags.begin(), all.flags.end(), std::uint8_t{1});
  return all;
}

TEST(LabelExpansion, FindsTheLeastEnergyOfTwoLabels) {
  // With two labels one expansion is exact; it is compared with all labellings of a small grid.
  const GridEnergy energy = noisy_energy(4, 3, 2, 8.0F);
  double least = 1e30;
  for (unsigned bits = 0; bits < 4096U; ++bits) {
    Raster<int> label(4, 3);
    for (std::size_t i = 0; i < 12; ++i) label.values()[i] = static_cast<int>(bits >> i & 1U);
    least = std::min(least, energy.value(label));
  }
  Raster<int> label(4, 3, 0);
  expand_labels(energy, everywhere(energy), 1, label, {});
  EXPECT_NEAR(energy.value(label), least, 0.5);  // the cut works in sixteenths
}

TEST(LabelExpansion, NeverIncreasesTheEnergyAndUsesOnlyCandidates) {
  const GridEnergy energy = noisy_energy(80, 150, 6, 10.0F);
  Candidates some = everywhere(energy);
  some.of(1, 1)[3] = 0;
  Raster<int> label(80, 150, 2);
  double last = energy.value(label);
  for (int passes = 1; passes <= 3; ++passes) {
    expand_labels(energy, some, passes, label, {});
    const double now = energy.value(label);
    EXPECT_LE(now, last + 1.0);
    last = now;
  }
  for (int y = 16; y < 32; ++y)
    for (int x = 16; x < 32; ++x) EXPECT_NE(label(x, y), 3);
}

}  // namespace
}  // namespace palpable::vision
