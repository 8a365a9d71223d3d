// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/peaks.hpp"

#include "palpable/describe/test_scenes.hpp"

#include <numbers>

namespace palpable::describe {
namespace {

TEST(Peaks, AreFoundWhereTheyAreWithTheirProminence) {
  const auto scene = two_hills();
  const auto peaks = find_peaks(*models::relief_of(scene));
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_NEAR(peaks[0].place.x_m, -0.03, 0.001);
  EXPECT_NEAR(peaks[0].place.y_m, 0.02, 0.001);
  EXPECT_NEAR(peaks[0].height_m, 0.013, 0.0001);
  EXPECT_NEAR(peaks[0].prominence_m, 0.012, 0.0002);
  EXPECT_NEAR(peaks[1].prominence_m, 0.008, 0.0002);
  // Half of a hill exp(-r²/a²) lies above half of its height at r² = a² ln 2.
  const double half_m2 = std::numbers::pi * 0.008 * 0.008 * std::numbers::ln2;
  for (const Peak& peak : peaks) EXPECT_NEAR(peak.area_m2, half_m2, 0.1 * half_m2);
}

TEST(Peaks, LeaveOutRipplesAndSpecks) {
  const auto rippled = surface_scene(
      [](double x, double y) { return bump(x, y, 0.0, 0.0, 0.01) + 0.0001 * std::sin(2000.0 * x); });
  EXPECT_EQ(find_peaks(*models::relief_of(rippled)).size(), 1U);
  // A peak of one sample is high but has no area.
  const auto needle = surface_scene([](double x, double y) {
    const bool is_needle = std::abs(x - 0.03) < 0.0006 && std::abs(y) < 0.0006;
    return bump(x, y, -0.02, 0.0, 0.01) + (is_needle ? 0.008 : 0.0);
  });
  EXPECT_EQ(find_peaks(*models::relief_of(needle)).size(), 1U);
}

TEST(Peaks, AreOneForAPlateauAndOneForARim) {
  const auto table =
      surface_scene([](double x, double y) { return std::abs(x) < 0.02 && std::abs(y) < 0.02 ? 0.01 : 0.0; });
  EXPECT_EQ(find_peaks(*models::relief_of(table)).size(), 1U);
  const auto bowl = surface_scene([](double x, double y) {
    const double r = (std::hypot(x, y) - 0.02) / 0.004;
    return 0.01 * std::exp(-r * r);
  });
  EXPECT_EQ(find_peaks(*models::relief_of(bowl)).size(), 1U);
}

TEST(Peaks, OfAPlateauAreAtItsMiddle) {
  for (const Place middle : {Place{-0.025, 0.025}, Place{0.02, -0.01}}) {
    const auto table = surface_scene([&](double x, double y) {
      // Only slightly higher at its lower edge, as stereo matching leaves it.
      const bool is_table = std::hypot(x - middle.x_m, y - middle.y_m) < 0.01;
      return is_table ? 0.01 - 0.001 * (y - middle.y_m) : 0.0;
    });
    const auto peaks = find_peaks(*models::relief_of(table));
    ASSERT_EQ(peaks.size(), 1U);
    EXPECT_NEAR(peaks[0].place.x_m, middle.x_m, 0.002);
    EXPECT_NEAR(peaks[0].place.y_m, middle.y_m, 0.002);
  }
}

TEST(Peaks, OfASurfaceTurnedOverAreItsHollows) {
  const auto hollow = surface_scene([](double x, double y) { return 0.02 - bump(x, y, 0.01, 0.01, 0.01); });
  PeakOptions options;
  options.turned_over = true;
  const auto peaks = find_peaks(*models::relief_of(hollow), options);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].place.x_m, 0.01, 0.001);
  EXPECT_NEAR(peaks[0].height_m, 0.01, 0.0002);
}

TEST(Peaks, AreNotTheHighEdgeOfATiltedGround) {
  // 100 mm long, it rises by 6 mm; a hill of 5 mm stands on its low part.
  const auto tilt = [](double x, double) { return 0.003 + 0.06 * x; };
  EXPECT_TRUE(find_peaks(*models::relief_of(surface_scene(tilt))).empty());
  const auto scene =
      surface_scene([&](double x, double y) { return tilt(x, y) + bump(x, y, -0.03, 0.01, 0.005); });
  const auto peaks = find_peaks(*models::relief_of(scene));
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].place.x_m, -0.03, 0.001);
  EXPECT_NEAR(peaks[0].height_m, 0.003 - 0.0018 + 0.005, 0.0002) << "height, not height above the ground";
  EXPECT_NEAR(peaks[0].prominence_m, 0.005, 0.0003);
  PeakOptions options;
  options.above_ground = false;
  EXPECT_EQ(find_peaks(*models::relief_of(scene), options).size(), 2U);
}

TEST(Peaks, AreNoneOnALevelSurface) {
  const auto level = surface_scene([](double, double) { return 0.002; });
  EXPECT_TRUE(find_peaks(*models::relief_of(level)).empty());
}

}  // namespace
}  // namespace palpable::describe
