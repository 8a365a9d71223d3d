// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/height_lines.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

Raster<float> cone() {
  Raster<float> z(61, 41);
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 61; ++x)
      z(x, y) = static_cast<float>(std::max(0.0, 0.010 - 0.0005 * std::hypot(x - 30.0, y - 20.0)));
  return z;
}

TEST(EncodeHeightLines, DrawsClosedRingsAroundACone) {
  HeightLineOptions options;
  options.interval_m = 0.002;
  const auto svg = encode_height_lines(cone(), 0.001, options);
  ASSERT_TRUE(svg);
  std::size_t rings = 0;
  for (std::size_t from = svg->find("<path"); from != std::string::npos;
       from = svg->find("<path", from + 1)) {
    const std::size_t begin = svg->find("d=\"M", from) + 4;
    const std::size_t end = svg->find('"', begin);
    const std::string path = svg->substr(begin, end - begin);
    EXPECT_EQ(path.substr(0, path.find('L')), path.substr(path.rfind('L') + 1)) << "it closes";
    ++rings;
  }
  EXPECT_EQ(rings, 5U);
  EXPECT_NE(svg->find("width=\"61.000mm\""), std::string::npos);
  options.interval_m = 0.0;
  EXPECT_FALSE(encode_height_lines(cone(), 0.001, options));
  options.interval_m = 1e-6;
  EXPECT_FALSE(encode_height_lines(cone(), 0.001, options));
}

int paths_of(const std::string& svg) {
  int count = 0;
  for (std::size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1)) ++count;
  return count;
}

TEST(EncodeHeightLines, BeginWithAnOutlineAboveTheGround) {
  // A cone of 10 mm: its outline, and lines at 2, 4, 6 and 8 mm.
  HeightLineOptions options;
  options.outline_m = 0.0005;
  const auto svg = encode_height_lines(cone(), 0.001, options);
  ASSERT_TRUE(svg);
  EXPECT_EQ(paths_of(*svg), 5);
  EXPECT_NE(svg->find("stroke-width=\"1.200\""), std::string::npos);
}

TEST(EncodeHeightLines, LeaveOutShortLines) {
  HeightLineOptions options;
  options.outline_m = 0.0005;
  // The line at 8 mm is a ring of 4 mm radius, 25 mm long.
  options.least_length_m = 0.030;
  EXPECT_EQ(paths_of(*encode_height_lines(cone(), 0.001, options)), 4);
}

TEST(HeightLines, ArePolylinesFromTheMiddle) {
  // A ramp along x from 0 to 10 mm over 11 samples of 1 mm: its line at 5 mm is x = 0.
  Raster<float> ramp(11, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 11; ++x) ramp(x, y) = 0.001F * static_cast<float>(x);
  HeightLineOptions options;
  options.interval_m = 0.01;
  const auto lines = height_polylines(ramp, 0.001, options);
  ASSERT_TRUE(lines);
  ASSERT_EQ(lines->size(), 1U);
  for (const Vec3 point : (*lines)[0].points) EXPECT_NEAR(point.x, 0.0, 1e-9);
  EXPECT_NEAR(std::abs((*lines)[0].points.front().y), 0.002, 1e-9);
  options.interval_m = 0.0;
  EXPECT_FALSE(height_polylines(ramp, 0.001, options));
}

}  // namespace
}  // namespace palpable::formats
