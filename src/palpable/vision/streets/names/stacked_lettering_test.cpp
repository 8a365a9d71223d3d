// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/stacked_lettering.hpp"

#include <array>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// Lettering of 10 pixels height around `middle`, of which the end is `rise` pixels lower than the begin.
TextLine lettering_around(MapPoint middle, double length, double rise = 0.0) {
  TextLine line;
  line.height_px = 10.0;
  for (double u = -0.5; u <= 0.5; u += 1.0 / length)
    line.centre.push_back({middle.x + u * length, middle.y + u * rise});
  return line;
}

const ReadLine kRestaurant{"Restaurant", 0.95, false, {"Restaurant"}};
const ReadLine kSeeblick{"Seeblick", 0.95, false, {"Seeblick"}};

TEST(StackedLettering, IsWordsCentredBelowEachOther) {
  const std::array<ReadLine, 2> read{kRestaurant, kSeeblick};
  const auto stacked = [&read](const TextLine& second) {
    const std::array<TextLine, 2> lines{lettering_around({100, 50}, 60), second};
    const auto out = stacked_lettering(lines, read);
    return out[0] == 1 && out[1] == 1;
  };
  EXPECT_TRUE(stacked(lettering_around({101, 64}, 48)));
  EXPECT_FALSE(stacked(lettering_around({101, 90}, 48))) << "far below";
  EXPECT_FALSE(stacked(lettering_around({125, 64}, 48))) << "not centred";
  EXPECT_FALSE(stacked(lettering_around({101, 64}, 48, 20))) << "not level";
  EXPECT_FALSE(stacked(lettering_around({101, 52}, 48))) << "the same line";
  TextLine blue = lettering_around({101, 64}, 48);
  blue.colour = {60, 60, 200};
  EXPECT_FALSE(stacked(blue)) << "another colour";
}

TEST(StackedLettering, NeedsASecondLineThatSaysSomething) {
  const std::array<TextLine, 2> lines{lettering_around({100, 50}, 60), lettering_around({101, 64}, 48)};
  const std::array<ReadLine, 2> read{kRestaurant, ReadLine{}};
  EXPECT_EQ(stacked_lettering(lines, read)[0], 0) << "marks of a symbol";
}

}  // namespace
}  // namespace palpable::vision
