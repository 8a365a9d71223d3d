// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A hand at rest whose reading goes to and fro by one step of the sensor: nothing moved, so no limit may act.
#include "palpable/haptics/tick/test_loop.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

struct AtRest {
  double greatest_step_N = 0.0;
  double least_N = 1e9;
  double said_J = 0.0;
};

/// A hand that presses 3 mm deep within half a second and rests for a second; `is_out` tells in which ticks
/// its reading is a step too high, from the beginning on.
AtRest force_at_rest(double resolution_m, const std::function<bool(int)>& is_out, int delay = 0) {
  constexpr int kPresses = 500, kRests = 100, kTicks = 1600;
  constexpr double kDepth_m = 0.003, kAbove_m = 0.001;
  Loop loop(std::make_shared<SpringSurface>(flat, 500.0, 0.5));
  loop.device.mutable_traits().position_resolution_m = resolution_m;
  loop.device.mutable_traits().delay_samples = delay;
  loop.tick = std::make_unique<TickPipeline>(loop.device, loop.program, TickOptions{}, loop.events);
  AtRest rest;
  for (int n = 0; n < kTicks; ++n) {
    const double pressed = std::min(1.0, static_cast<double>(n) / kPresses);
    const double z_m = kAbove_m - pressed * (kAbove_m + kDepth_m);
    const double steps = std::round(z_m / resolution_m) + (is_out(n) ? 1.0 : 0.0);
    loop.device.reading = {{{0.0, 0.0, resolution_m * steps}}, device::Status::ok};
    const double before_N = n > 0 ? norm(loop.written()) : 0.0;
    loop.run(1);
    if (n < kPresses + kRests) continue;
    const double now_N = norm(loop.written());
    rest.greatest_step_N = std::max(rest.greatest_step_N, std::abs(now_N - before_N));
    rest.least_N = std::min(rest.least_N, now_N);
  }
  rest.said_J = loop.tick->counts().made_max_J;
  return rest;
}

class RestingHandOnASensor : public testing::TestWithParam<double> {};

TEST_P(RestingHandOnASensor, FeelsNoStepWhereItsReadingIsAStepOutNowAndThen) {
  std::mt19937 random(7);
  const auto rest = force_at_rest(GetParam(), [&](int) { return random() % 4U == 0U; });
  EXPECT_LT(rest.greatest_step_N, 0.1);
  EXPECT_GT(rest.least_N, 1.35);
}

INSTANTIATE_TEST_SUITE_P(Resolutions, RestingHandOnASensor, testing::Values(1e-6, 5e-6, 10e-6, 20e-6, 50e-6));

class RestingHandOnALateSensor : public testing::TestWithParam<int> {};

/// From before the contact on. Before, a hand lost all of the force with steps of 50 um, and with steps of 20
/// um and a delay of 2 nearly all.
TEST_P(RestingHandOnALateSensor, FeelsNoStepWhereItsReadingIsAStepOutInEachSecondTick) {
  for (const double resolution_m : {1e-6, 5e-6, 10e-6, 20e-6, 50e-6}) {
    const auto rest = force_at_rest(
        resolution_m, [](int n) { return n % 2 == 1; }, GetParam());
    EXPECT_LT(rest.greatest_step_N, 0.1) << resolution_m;
    EXPECT_GT(rest.least_N, 1.35) << resolution_m;
    EXPECT_LE(rest.said_J, 1e-6) << resolution_m;
  }
}

INSTANTIATE_TEST_SUITE_P(Delays, RestingHandOnALateSensor, testing::Values(0, 1, 2));

}  // namespace
}  // namespace palpable::haptics
