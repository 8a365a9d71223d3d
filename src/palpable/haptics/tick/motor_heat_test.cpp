// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The budget of heat in the tick.
#include "palpable/haptics/tick/test_loop.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

TEST(MotorHeat, LowersTheForceOfAHandThatPressesForLong) {
  Loop loop(plane(1000.0));
  loop.device.mutable_traits().continuous_force_N = 1.0;
  loop.tick = std::make_unique<TickPipeline>(loop.device, loop.program, TickOptions{}, loop.events);
  loop.device.reading.position.v.z = 0.001;
  loop.run(20);
  for (int n = 0; n < 10; ++n) {
    loop.device.reading.position.v.z -= 5e-4;
    loop.run(1);
  }
  loop.run(1000);
  EXPECT_NEAR(loop.written().z, 3.0, 1e-9);
  const Vec3 before = loop.written();
  loop.run(30'000);
  EXPECT_LT(loop.written().z, 1.5);
  EXPECT_GE(loop.written().z, 1.0);
  EXPECT_EQ(loop.count(TouchEvent::Kind::motors_warm), 1);
  EXPECT_NEAR(loop.tick->counts().heat, 1.0, 0.2);
  // A reopened device begins as warm as it was.
  TickOptions warm;
  warm.heat = 1.0;
  Loop again(plane(1000.0));
  again.device.mutable_traits().continuous_force_N = 1.0;
  again.tick = std::make_unique<TickPipeline>(again.device, again.program, warm, again.events);
  again.device.reading.position.v.z = -0.004;
  again.run(1000);
  EXPECT_LT(norm(again.written()), 1.2);
  EXPECT_GT(norm(before), 2.9);
}

}  // namespace
}  // namespace palpable::haptics
