// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/tracing_figure.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

/// The grey value at a point of the scene.
double grey_at(const TracingFigure& figure, Vec3 p) {
  const int x = static_cast<int>(std::lround(p.x / figure.pixel_m + 0.5 * (figure.picture.width() - 1)));
  const int y = static_cast<int>(std::lround(-p.y / figure.pixel_m + 0.5 * (figure.picture.height() - 1)));
  return figure.picture(x, y);
}

TEST(TracingFigures, AreThoseOfThePaper) {
  std::set<std::string> names;
  for (const auto& figure : all_tracing_figures(1)) names.insert(figure.name);
  EXPECT_EQ(names.size(), 11U);
  for (const char* name : {"line-000", "line-135", "semicircle-045", "rectangle", "letter-h", "ultrasound"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(TracingFigures, HaveOutlinesOfTheStatedLengths) {
  const auto length = [](const TracingFigure& f) { return LineByLength(f.nominal, f.ends).length_m(); };
  EXPECT_NEAR(length(rectangle_figure()), 0.260, 1e-9);
  EXPECT_NEAR(length(letter_h_figure()), 0.352, 1e-9);
  EXPECT_NEAR(length(ultrasound_figure(1)), 0.072, 0.002);
  EXPECT_NEAR(length(line_figure(45)), 0.060, 1e-9);
  EXPECT_NEAR(length(semicircle_figure(90)), M_PI * 0.030, 1e-4);
}

TEST(TracingFigures, AreDarkWithinTheirLineAndLightOutside) {
  const auto rectangle = rectangle_figure();
  EXPECT_EQ(grey_at(rectangle, {0, 0, 0}), 60);
  EXPECT_EQ(grey_at(rectangle, {0.0395, 0.0245, 0}), 60);
  EXPECT_EQ(grey_at(rectangle, {0.0405, 0.0, 0}), 220);
  const auto line = line_figure(45);
  for (const Vec3& p : {line.nominal[10], line.nominal[50]}) EXPECT_EQ(grey_at(line, p), 60);
  EXPECT_EQ(grey_at(line, {0.01, -0.01, 0}), 220);
}

TEST(TracingFigures, RotateCounterClockwise) {
  const auto line = line_figure(45);
  EXPECT_GT(line.nominal.back().x, 0.02);
  EXPECT_GT(line.nominal.back().y, 0.02) << "up to the right";
}

TEST(TracingFigures, HaveSpeckleThatIsDarkerInside) {
  const auto scan = ultrasound_figure(1);
  const auto statistics = [&](Vec3 centre) {
    double sum = 0.0;
    double squares = 0.0;
    int n = 0;
    for (double y = -0.006; y < 0.006; y += 0.0002)
      for (double x = -0.006; x < 0.006; x += 0.0002, ++n) {
        const double v = grey_at(scan, centre + Vec3{x, y, 0});
        sum += v;
        squares += v * v;
      }
    return std::pair(sum / n, std::sqrt(squares / n - sum / n * sum / n));
  };
  const auto inside = statistics({0, 0, 0});
  const auto outside = statistics({0.04, 0, 0});
  // 12 dB of 50 are 61 of 255 grey levels; the magnitude of fully developed speckle has a standard deviation
  // of 5.6 dB.
  EXPECT_NEAR(outside.first - inside.first, 61.0, 12.0);
  EXPECT_NEAR(outside.second, 5.6 / 50.0 * 255.0, 6.0);
  EXPECT_NE(ultrasound_figure(2).picture, scan.picture);
  EXPECT_EQ(ultrasound_figure(1).picture, scan.picture);
}

}  // namespace
}  // namespace palpable::study
