// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A surface that moves from one picture of a live source to the next.
#include "palpable/core/system/allocations.hpp"
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/test_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <list>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kStiffness_N_per_m = 500.0, kDamping_Ns_per_m = 2.0, kFade_s = 0.03;

TickOptions of_pictures() {
  TickOptions options;
  options.fade_s = kFade_s;
  return options;
}

LawParameters touched(double friction = 0.0) {
  LawParameters p = frictionless();
  p.stiffness_N_per_m = kStiffness_N_per_m;
  p.damping_Ns_per_m = kDamping_Ns_per_m;
  p.static_friction = friction;
  return p;
}

/// A plane through z_m above the origin.
models::Scene plane_at(double z_m, double slope = 0.0) {
  Raster<float> heights(100, 80);
  for (int y = 0; y < heights.height(); ++y)
    for (int x = 0; x < heights.width(); ++x)
      heights(x, y) = static_cast<float>(z_m + slope * kPixel_m * (x - 49.5));
  return scene_of(std::move(heights));
}

/// A hand whose readings the test sets, on a plane that another one follows.
struct Moved {
  Moved(double from_m, double to_m, Vec3 hand_m, Succession succession, double slope = 0.0,
        double friction = 0.0)
      : loop(made(plane_at(from_m, slope), touched(friction)), of_pictures()) {
    next.touchable = made(plane_at(to_m, slope), touched(friction));
    next.id = 2;
    next.succession = succession;
    // The hand enters from above.
    for (int n = 0; n <= 400; ++n) {
      loop.device.reading.position.v = hand_m + Vec3{0.0, 0.0, 2e-5 * (400 - n)};
      loop.run(1);
    }
    loop.run(100);
    loop.tick->change(next);
  }
  Loop loop;
  HapticScene next;
};

/// By how much more a hand is pushed, N, 25 ms after the beginning, because the surface is known to move.
Vec3 pushed_by_velocity(double from_m, double to_m, double slope = 0.0, double friction = 0.0) {
  Vec3 pushed;
  for (const Succession succession : {Succession::moves, Succession::replaces}) {
    Moved moved(from_m, to_m, {0.0, 0.0, from_m - 0.002}, succession, slope, friction);
    moved.loop.run(26);
    pushed += succession == Succession::moves ? moved.loop.written() : -moved.loop.written();
  }
  return pushed;
}

TEST(MovingSurface, ItsVelocityEntersTheDamper) {
  // 20 mm/s, eased over 10 ms.
  const double damper_N = kDamping_Ns_per_m * 0.02 * (1.0 - std::exp(-2.4));
  EXPECT_NEAR(pushed_by_velocity(0.005, 0.0056).z, damper_N, 0.1 * damper_N);
  EXPECT_NEAR(pushed_by_velocity(0.0056, 0.005).z, -damper_N, 0.1 * damper_N);
  EXPECT_EQ(pushed_by_velocity(0.005, 0.005), Vec3{});
}

TEST(MovingSurface, DoesNotDampAHandThatGoesWithIt) {
  for (const Succession succession : {Succession::moves, Succession::replaces}) {
    Moved moved(0.005, 0.0056, {0.0, 0.0, 0.003}, succession);
    for (int n = 0; n < 28; ++n) {
      moved.loop.device.reading.position.v.z += 2e-5;
      moved.loop.run(1);
    }
    const double damper_N = moved.loop.written().z - kStiffness_N_per_m * 0.002;
    const double unaware_N = -kDamping_Ns_per_m * 0.02;
    EXPECT_NEAR(damper_N, succession == Succession::moves ? 0.0 : unaware_N, 0.02);
  }
}

// It moves along the axis of its heights, on a slope partly along the surface: a proxy that friction holds
// goes with it. Without friction it takes nothing along.
TEST(MovingSurface, TakesAHeldHandAlongItsSlope) {
  const Vec3 up = unit(Vec3{1.0, 0.0, 0.5}), out = unit(Vec3{-0.5, 0.0, 1.0});
  const double damper_N = kDamping_Ns_per_m * 0.005 * (1.0 - std::exp(-2.4));
  const Vec3 held = pushed_by_velocity(0.005, 0.00515, 0.5, 1.0);
  EXPECT_NEAR(dot(held, out), out.z * damper_N, 0.15 * damper_N);
  EXPECT_NEAR(dot(held, up), up.z * damper_N, 0.15 * damper_N);
  const Vec3 slides = pushed_by_velocity(0.005, 0.00515, 0.5);
  EXPECT_NEAR(dot(slides, out), out.z * damper_N, 0.15 * damper_N);
  EXPECT_NEAR(dot(slides, up), 0.0, 0.02 * damper_N);
}

// From 1 mm above the hand to 1 mm below it, and back.
TEST(MovingSurface, LeavesAHandAndMeetsItWhenItIsThere) {
  Moved falls(0.005, 0.003, {0.0, 0.0, 0.004}, Succession::moves);
  Moved rises(0.003, 0.005, {0.0, 0.0, 0.004}, Succession::moves);
  for (int n = 1; n <= 60; ++n) {
    falls.loop.run(1);
    rises.loop.run(1);
    if (n > 18) {
      EXPECT_EQ(falls.loop.written(), Vec3{}) << n;
      EXPECT_FALSE(falls.loop.sample->has(flag::kContact)) << n;
    }
    EXPECT_EQ(rises.loop.sample->has(flag::kContact), rises.loop.written() != Vec3{}) << n;
  }
  EXPECT_NEAR(rises.loop.written().z, kStiffness_N_per_m * 0.001, 0.01);
}

TEST(MovingSurface, LiftsAHandNoFasterThanAChangeOfScene) {
  Moved moved(0.003, 0.008, {0.0, 0.0, 0.004}, Succession::moves);
  double before_N = 0.0;
  for (int n = 1; n <= 200; ++n) {
    moved.loop.run(1);
    const double now_N = moved.loop.written().z;
    EXPECT_LE(now_N - before_N, 1.1 * kStiffness_N_per_m * kLift_m_per_s * kT_s + kDamping_Ns_per_m * 0.004);
    before_N = now_N;
  }
  EXPECT_NEAR(before_N, kStiffness_N_per_m * 0.004, 0.02);
}

/// A hand on pictures of a plane, 30 a second, that is elsewhere after `each` of them.
struct Carried {
  explicit Carried(const std::shared_ptr<const Touchable> (&pictures)[2],
                   Succession succession = Succession::moves, int each = 10)
      : hand(options()) {
    HapticScene first{pictures[0], {}, 1};
    Ring<TouchEvent> events(64);
    TickPipeline tick(hand, first, of_pictures(), events);
    std::list<HapticScene> scenes;
    hand.place({0.0, 0.0, 0.004});
    for (int n = 0; n < 6000; ++n) {
      // Some goals are in the air.
      hand.set_goal({0.0, 0.0, 0.003 + 0.003 * std::sin(0.004 * n)});
      if (n % 33 == 20 && !tick.fading()) {
        const auto& next = pictures[n / (33 * each) % 2];
        scenes.push_back({next, {}, static_cast<std::uint32_t>(n), {}, succession});
        tick.change(scenes.back());
      }
      tick.step(kT_s * n, kT_s);
      most_J = std::max(most_J, hand.total_J() - tick.counts().scene_change_J);
    }
    counts = tick.counts();
  }
  static device::HandOptions options() {
    device::HandOptions options;
    options.script.kind = device::HandScriptOptions::Kind::hold;
    return options;
  }
  CountedHand hand;
  TickCounts counts;
  /// What the hand received beyond what the changes brought.
  double most_J = 0.0;
};

TEST(MovingSurface, GivesAHandNoMoreThanItBrings) {
  const Carried carried({made(plane_at(0.003), touched(0.3)), made(plane_at(0.004), touched(0.3))});
  EXPECT_GT(carried.counts.scene_change_J, 1e-3);
  EXPECT_LE(carried.most_J, 1e-6);
  EXPECT_LE(carried.counts.made_max_without_controller_J, 1e-6);
}

// During a change to another scene the account begins anew in each tick, so that it shows hardly anything.
TEST(MovingSurface, HidesNoEnergyThatALawMakes) {
  const auto low = [](double, double) { return SpringSurface::Height{0.004, 0.0, 0.0}; };
  const auto high = [](double, double) { return SpringSurface::Height{0.00402, 0.0, 0.0}; };
  // Their dampers push a hand the way it goes.
  const std::shared_ptr<const Touchable> pictures[]{
      std::make_shared<const SpringSurface>(low, 300.0, -1.0, 1),
      std::make_shared<const SpringSurface>(high, 300.0, -1.0, 2)};
  const auto shown_J = [&](Succession succession) {
    return Carried(pictures, succession, 1).counts.made_max_without_controller_J;
  };
  EXPECT_GT(shown_J(Succession::moves), 2e-6);
  EXPECT_GT(shown_J(Succession::moves), 5.0 * shown_J(Succession::replaces));
}

/// A bowl with a ridge before its rim, as the surface by which a robot is driven.
std::shared_ptr<const Touchable> drive_surface(double ridge_m) {
  Raster<float> heights(100, 80);
  for (int y = 0; y < heights.height(); ++y)
    for (int x = 0; x < heights.width(); ++x) {
      const double away_m = kPixel_m * std::hypot(x - 49.5, y - 39.5);
      const double ridge = ridge_m / (1.0 + std::exp((0.005 - away_m) / 0.0008));
      heights(x, y) = static_cast<float>(20.0 * away_m * away_m + ridge);
    }
  LawParameters p;
  p.law = Law::rolling;
  return made(scene_of(std::move(heights)), p);
}

// A weight on slopes that change with each picture, late ticks and stalls among them.
TEST(MovingSurface, ADriveSurfaceMakesNoEnergy) {
  const std::shared_ptr<const Touchable> pictures[]{drive_surface(0.0), drive_surface(0.001),
                                                    drive_surface(0.002), drive_surface(0.0005)};
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    CountedHand hand(Carried::options());
    HapticScene first{pictures[0], {}, 1};
    Ring<TouchEvent> events(64);
    TickPipeline tick(hand, first, of_pictures(), events);
    std::list<HapticScene> scenes;
    double t_s = 0.0, phase = 0.0;
    for (int n = 0; n < 10000; ++n) {
      phase += 0.002 + 0.00001 * seed;
      hand.set_goal({0.009 * std::sin(phase), 0.007 * std::sin(1.7 * phase), 0.01});
      if (n % 33 == 20 && !tick.fading()) {
        scenes.push_back({pictures[random() % 4], {}, static_cast<std::uint32_t>(n), {}, Succession::moves});
        tick.change(scenes.back());
      }
      const int late = random() % 100 == 0 ? 1 + static_cast<int>(random() % 9) : 1;
      hand.stall(late);
      t_s += kT_s * late;
      tick.step(t_s, kT_s * late);
    }
    EXPECT_LE(tick.counts().made_max_J, 1e-6) << seed;
    EXPECT_LE(tick.counts().made_max_without_controller_J, 1e-6) << seed;
    EXPECT_LE(hand.total_J() - tick.counts().scene_change_J, 1e-6) << seed;
  }
}

TEST(MovingSurface, IsTouchedWithoutAllocations) {
  ASSERT_TRUE(allocations_are_counted());
  const auto low = made(plane_at(0.003), touched(0.3)), high = made(plane_at(0.004), touched(0.3));
  Loop loop(low, of_pictures());
  const HapticScene pictures[2]{{low, {}, 1, {}, Succession::moves}, {high, {}, 2, {}, Succession::moves}};
  loop.device.reading.position.v.z = 0.0035;
  loop.run(300);
  const AllocationScope scope;
  for (int k = 1; k < 20; ++k) {
    loop.tick->change(pictures[k % 2]);
    loop.run(40);
  }
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::haptics
