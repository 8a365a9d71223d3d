// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A pull along a way: bounded in force and in energy, and enough to lead a hand that only presses.
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/effect/route_pull.hpp"
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/safety/test_hands.hpp"
#include "palpable/haptics/tick/test_pressing_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// To the right for 12 mm, then up for 9 mm, on a plate of 20 x 16 mm.
models::RouteGuide corner() {
  models::RouteGuide guide;
  guide.line_m = {{-0.006, -0.004}, {0.006, -0.004}, {0.006, 0.005}};
  return guide;
}

TEST(RoutePull, NeverExceedsItsForceAndEndsBesideTheWay) {
  const models::RouteGuide guide = corner();
  const RoutePull pull(guide);
  double most_N = 0.0;
  for (double x = -0.03; x < 0.03; x += 0.0003)
    for (double y = -0.03; y < 0.03; y += 0.0003) most_N = std::max(most_N, norm(pull.force_N({x, y, 0.0})));
  EXPECT_LE(most_N, guide.force_N * (1.0 + 1e-6));
  EXPECT_GT(most_N, 0.99 * guide.force_N);
  EXPECT_EQ(pull.force_N({-0.006, 0.005, 0.0}), Vec3{});
  EXPECT_NEAR(pull.force_N({-0.003, -0.004, 0.0}).x, guide.force_N, 1e-3);
  EXPECT_NEAR(pull.force_N({0.006, 0.0, 0.0}).y, guide.force_N, 1e-3);
  EXPECT_NEAR(norm(pull.force_N({0.006, 0.005, 0.0})), 0.0, 0.05 * guide.force_N) << "at the end";
}

TEST(RoutePull, ItsReserveBoundsWhatItGivesEvenToAHandThatComesBackThroughTheAir) {
  const RoutePull pull(corner());
  PullTouch state{};
  double given_J = 0.0;
  Vec3 held_N, place;
  for (int round = 0; round < 100; ++round)
    for (int n = 0; n <= 240; ++n) {
      // Along the first leg in contact, and back in the air.
      Hand hand;
      const bool contact = n < 120;
      hand.position = {{-0.006 + 0.0001 * (contact ? n : 240 - n), -0.004, contact ? 0.0 : 0.01}};
      given_J += dot(held_N, hand.position.v - place);
      place = hand.position.v;
      LawOutput output;
      output.contact = contact;
      pull.add(hand, state, output);
      held_N = output.force_N.v;
      EXPECT_TRUE(contact || held_N == Vec3{});
    }
  EXPECT_LE(given_J, pull.reserve_J() * (1.0 + 1e-9));
  EXPECT_GT(given_J, 0.95 * pull.reserve_J());
}

TEST(RoutePull, HasAFullReserveWhateverAnotherPullHasGiven) {
  // As a second search on the same surface, whose touch goes on.
  PullTouch state{};
  models::RouteGuide shorter = corner();
  shorter.line_m = {{-0.006, -0.004}, {-0.003, -0.004}};
  const RoutePull first(corner()), second(shorter);
  const auto pulled_N = [&state](const RoutePull& pull, double x_m) {
    Hand hand;
    hand.position = {{x_m, -0.004, 0.0}};
    LawOutput output;
    output.contact = true;
    pull.add(hand, state, output);
    return norm(output.guide_N);
  };
  for (int n = 0; n < 600; ++n) pulled_N(first, -0.006 + 0.00002 * n);
  EXPECT_GT(state.spent_J, second.reserve_J());
  double force_N = 0.0;
  for (int n = 0; n < 500; ++n) force_N = pulled_N(second, -0.006);
  EXPECT_NEAR(force_N, shorter.force_N, 0.05 * shorter.force_N);
}

/// Where the hand is after this time on a smooth plate, and the energy that was generated.
struct Led {
  Vec3 place;
  double made_J = 0.0;
};

Led led(double force_N, double seconds) {
  models::Scene scene = flat_ground();
  models::RouteGuide guide = corner();
  guide.force_N = force_N;
  scene.guide = std::make_shared<const models::RouteGuide>(guide);
  LawParameters parameters = frictionless();
  parameters.damping_Ns_per_m = 1.0;
  parameters.static_friction = 0.05;
  HapticScene program;
  program.touchable = made(scene, parameters);
  PressingHand hand({-0.006, -0.004, 0.0055});
  TickOptions options;
  options.passivity = Passivity::observe;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(hand, program, options, events);
  for (int n = 0; n < static_cast<int>(1000 * seconds); ++n) {
    tick.step(0.001 * n, 0.001);
    while (events.take()) {
    }
  }
  return {hand.place(), tick.counts().made_max_without_controller_J};
}

TEST(RoutePull, LeadsAHandThatOnlyPressesAroundACornerToTheEnd) {
  const Led with = led(0.3, 3.0), without = led(0.0, 3.0);
  EXPECT_LE(std::hypot(with.place.x - 0.006, with.place.y - 0.005), 0.002);
  EXPECT_NEAR(without.place.x, -0.006, 1e-4);
  EXPECT_LE(with.made_J, 1e-6) << "its reserve is known to the observer";
}

/// The energy that a hand gets beyond the reserve while it moves about at random for five seconds.
double made_by_moving(const device::HandOptions& options, double force_N) {
  device::SimulatedHand hand(options);
  models::Scene scene = flat_ground();
  models::RouteGuide guide = corner();
  guide.force_N = force_N;
  scene.guide = std::make_shared<const models::RouteGuide>(guide);
  const auto safe = safe_contact(hand.traits(), options.rate_hz, 1.0, 1e5, 0.5);
  LawParameters parameters = frictionless();
  parameters.stiffness_N_per_m = safe.stiffness_N_per_m;
  parameters.damping_Ns_per_m = safe.damping_Ns_per_m;
  HapticScene program;
  program.touchable = made(scene, parameters);
  TickOptions observed;
  observed.passivity = Passivity::observe;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(hand, program, observed, events);
  for (int n = 0; n < 5000; ++n) {
    tick.step(0.001 * n, 0.001);
    while (events.take()) {
    }
  }
  EXPECT_GT(tick.counts().contact_ticks, 500U);
  return tick.counts().made_max_without_controller_J;
}

TEST(RoutePull, MovingHandsGetNoMoreEnergyThanItsReserve) {
  Hands hands(23);
  for (int round = 0; round < 4; ++round) {
    device::HandOptions options = hands.next();
    options.script.kind = device::HandScriptOptions::Kind::random;
    options.script.workspace_m = {0.016, 0.012, 0.02};
    options.script.seed = static_cast<std::uint64_t>(round) + 1;
    // Without a pull these hands make up to 13 uJ on a frictionless plate; the reserve is 13 mJ.
    EXPECT_LE(made_by_moving(options, 0.3), 0.01 * RoutePull(corner()).reserve_J()) << "round " << round;
  }
}

}  // namespace
}  // namespace palpable::haptics
