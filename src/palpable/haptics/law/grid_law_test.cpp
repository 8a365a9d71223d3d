// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/grid_law.hpp"

#include "palpable/haptics/law/laws.hpp"
#include "palpable/models/scene/test_grid.hpp"

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// A plate, 4 mm high.
models::Scene plate() {
  return models::grid_scene({21, 21, 9}, 0.004F, [](int z) { return z <= 5; });
}

LawOutput felt(const Touchable& touchable, Vec3 place, Vec3 velocity = {}) {
  TouchState state;
  Hand hand;
  hand.position.v = place;
  hand.velocity_m_per_s.v = velocity;
  return touchable.evaluate(hand, state);
}

TEST(GridLaw, PushesOutOfThePlateAsSpringAndDamper) {
  LawParameters parameters;
  parameters.law = Law::grid;
  parameters.stiffness_N_per_m = 1000.0;
  parameters.damping_Ns_per_m = 2.0;
  const auto touchable = make_touchable(plate(), parameters);
  ASSERT_TRUE(touchable.has_value());
  // The surface stands half a spacing above the last occupied points.
  const LawOutput pressed = felt(**touchable, {0.0003, 0.0002, 0.0035});
  EXPECT_TRUE(pressed.contact);
  EXPECT_NEAR(pressed.force_N.v.z, 1.0, 0.02);
  EXPECT_NEAR(pressed.force_N.v.x, 0.0, 0.02);
  EXPECT_NEAR(pressed.proxy.v.z, 0.0045, 2e-5);
  // Entering is damped; leaving never pulls.
  EXPECT_NEAR(felt(**touchable, {0.0, 0.0, 0.0035}, {0.0, 0.0, -0.1}).force_N.v.z, 1.2, 0.02);
  EXPECT_EQ(norm(felt(**touchable, {0.0, 0.0, 0.0035}, {0.0, 0.0, 5.0}).force_N), 0.0);
  EXPECT_EQ(norm(felt(**touchable, {0.0, 0.0, 0.0046}).force_N), 0.0);
}

TEST(GridLaw, IsTheGridsOwnAndTakesAPoint) {
  EXPECT_EQ(laws_for(plate()).front(), Law::grid);
  LawParameters parameters;
  parameters.law = Law::grid;
  EXPECT_EQ(find_parameter(description_of(Law::grid), &LawParameters::radius_m), nullptr);
  parameters.law = Law::proxy;
  EXPECT_FALSE(make_touchable(plate(), parameters).has_value());
}

}  // namespace
}  // namespace palpable::haptics
