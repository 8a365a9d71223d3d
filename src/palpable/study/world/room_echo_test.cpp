// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/room_echo.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

const Point<WorldFrame> kFrom{{1.0, -0.5, 1.2}}, kTo{{-1.0, 0.7, 0.8}};
constexpr double kRate_hz = 16'000.0;

TEST(RoomEcho, WithoutARoomIsOnePulseAfterItsWay) {
  const RoomEcho room;
  const auto response = impulse_response(room, kFrom, kTo, kRate_hz, 0.02);
  const double way_m = norm(kFrom.v - kTo.v);
  double sum = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < response.size(); ++i) {
    sum += double{response[i]};
    moment += double{response[i]} * static_cast<double>(i);
  }
  EXPECT_NEAR(sum, 1.0 / way_m, 0.01 / way_m);
  EXPECT_NEAR(moment / sum - kEchoLead, way_m / 343.2 * kRate_hz, 0.05);
}

/// The floor is the nearest mirror of a place above it.
TEST(RoomEcho, TheFirstReflectionIsThatOfTheFloor) {
  RoomEcho room{{20.0, 20.0, 30.0}, 0.5};
  const auto response = impulse_response(room, kFrom, kTo, kRate_hz, 0.012);
  const Vec3 mirrored{kFrom.v.x, kFrom.v.y, -kFrom.v.z};
  const double way_m = norm(mirrored - kTo.v);
  const auto at = static_cast<std::size_t>(std::lround(way_m / 343.2 * kRate_hz)) + kEchoLead;
  double sum = 0.0;
  for (std::size_t i = at - 8; i < at + 8; ++i) sum += double{response[i]};
  EXPECT_NEAR(sum, 0.5 / way_m, 0.05 / way_m);
}

/// The reverberation time of the response itself, by Schroeder's integral.
TEST(RoomEcho, FadesInTheTimeThatIsAskedFor) {
  RoomEcho room{{5.0, 4.0, 2.5}};
  constexpr double kAsked_s = 0.3;
  room.reflection = reflection_for(room, kFrom, kTo, kAsked_s);
  EXPECT_GT(room.reflection, 0.5);
  EXPECT_LT(room.reflection, 1.0);
  auto left = impulse_response(room, kFrom, kTo, 8'000.0, kAsked_s);
  // Near 0 Hz all images add up, which Allen & Berkley filter out; the difference of samples does.
  std::adjacent_difference(left.begin(), left.end(), left.begin());
  float sum = 0.0F;
  for (std::size_t i = left.size(); i-- > 0;) left[i] = sum += left[i] * left[i];
  const auto time_of = [&](double level_db) {
    const auto below = std::ranges::find_if(
        left, [&](float energy) { return 10.0 * std::log10(double{energy / left.front()}) < level_db; });
    return static_cast<double>(below - left.begin()) / 8'000.0;
  };
  EXPECT_NEAR(2.0 * (time_of(-35.0) - time_of(-5.0)), kAsked_s, 0.03);
}

}  // namespace
}  // namespace palpable::study
