// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/grid_law.hpp"

#include "palpable/haptics/laws.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// A plate, 4 mm high, a point every millimetre.
models::Scene plate() {
  auto relief = models::Relief::from_samples(Raster<float>(20, 20, 0.004F), 0.001);
  EXPECT_TRUE(relief.has_value());
  models::Occupancy o;
  o.counts = {21, 21, 9};
  o.origin_m = {-0.01, -0.01, -0.001};
  o.spacing_m = 0.001;
  for (int z = 0; z < 9; ++z)
    for (int i = 0; i < 21 * 21; ++i) o.occupied.push_back(z <= 5 ? 1 : 0);
  auto grid = models::OccupancyGrid::from(o, Work{});
  EXPECT_TRUE(grid.has_value());
  models::Scene scene;
  scene.model = std::make_shared<const models::Grid>(
      models::Grid{*std::move(grid), std::make_shared<const models::Relief>(*std::move(relief))});
  return scene;
}

Feel felt(const Touchable& touchable, Vec3 place, Vec3 velocity = {}) {
  TouchState state;
  Hand hand;
  hand.position.v = place;
  hand.velocity_m_per_s.v = velocity;
  return touchable.feel(hand, state);
}

TEST(GridLaw, PushesOutOfThePlateAsSpringAndDamper) {
  LawParameters parameters;
  parameters.law = Law::grid;
  parameters.stiffness_N_per_m = 1000.0;
  parameters.damping_Ns_per_m = 2.0;
  const auto touchable = make_touchable(plate(), parameters);
  ASSERT_TRUE(touchable.has_value());
  // The surface stands half a spacing above the last occupied points.
  const Feel pressed = felt(**touchable, {0.0003, 0.0002, 0.0035});
  EXPECT_TRUE(pressed.contact);
  EXPECT_NEAR(pressed.force_N.v.z, 1.0, 0.02);
  EXPECT_NEAR(pressed.force_N.v.x, 0.0, 0.02);
  EXPECT_NEAR(pressed.proxy.v.z, 0.0045, 2e-5);
  // Entering adds damping, leaving never pulls.
  EXPECT_NEAR(felt(**touchable, {0.0, 0.0, 0.0035}, {0.0, 0.0, -0.1}).force_N.v.z, 1.2, 0.02);
  EXPECT_EQ(norm(felt(**touchable, {0.0, 0.0, 0.0035}, {0.0, 0.0, 5.0}).force_N), 0.0);
  EXPECT_EQ(norm(felt(**touchable, {0.0, 0.0, 0.0046}).force_N), 0.0);
}

TEST(GridLaw, IsTheGridsOwnAndTakesAPoint) {
  EXPECT_EQ(laws_for(plate()).front(), Law::grid);
  LawParameters parameters;
  parameters.law = Law::grid;
  parameters.radius_m = 0.001;
  EXPECT_FALSE(make_touchable(plate(), parameters).has_value());
  parameters.radius_m = 0.0;
  parameters.law = Law::proxy;
  EXPECT_FALSE(make_touchable(plate(), parameters).has_value());
}

}  // namespace
}  // namespace palpable::haptics
