// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/steered_response.hpp"

#include "palpable/hearing/test_arrays.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::hearing {
namespace {

constexpr double kRate_hz = 192'000.0;

/// Correlations with a narrow peak, 12 lags wide, at the delays of a far sound.
std::vector<PairCorrelation> peaks_of(const SteeredResponse& response, const Microphones& at, Vec3 towards) {
  std::vector<PairCorrelation> out = response.pairs();
  for (PairCorrelation& pair : out) {
    const double late_m = dot(at.positions_m[pair.second].v - at.positions_m[pair.first].v, towards);
    const double peak = late_m / at.speed_of_sound_m_per_s * kRate_hz;
    for (int lag = -response.most_lag(); lag <= response.most_lag(); ++lag)
      pair.at_lag.push_back(static_cast<float>(std::exp(-std::pow((lag - peak) / 6.0, 2))));
  }
  return out;
}

/// Small, and larger than the grid's finest cells are made for.
TEST(SteeredResponse, FindsNarrowPeaksAnywhereOnTheSphere) {
  for (const double side_m : {0.05, 0.2, 1.0}) {
    const Microphones at{{{{0, 0, 0}}, {{side_m, 0, 0}}, {{0, side_m, 0}}, {{0, 0, side_m}}}};
    const SteeredResponse response(at, *geometry_of(at), kRate_hz);
    for (int n = 0; n < 12; ++n) {
      const Vec3 towards = direction_at(-175.0 + 31.0 * n, -77.0 + 14.0 * n).v;
      const ResponsePeak peak = response.find(peaks_of(response, at, towards));
      EXPECT_LT(angle_deg(peak.direction.v, towards), 0.3) << side_m << " m, direction " << n;
      EXPECT_NEAR(peak.response, 1.0, 0.01);
      EXPECT_LT(peak.mean_response, 0.6);
    }
  }
}

TEST(SteeredResponse, OfAPlaneIsSearchedOnOneSide) {
  const Microphones& at = kLevelArray;
  const SteeredResponse response(at, *geometry_of(at), kRate_hz);
  const Vec3 below = direction_at(110.0, -30.0).v;
  const ResponsePeak peak = response.find(peaks_of(response, at, below));
  EXPECT_LT(angle_deg(peak.direction.v, direction_at(110.0, 30.0).v), 0.3);
}

}  // namespace
}  // namespace palpable::hearing
