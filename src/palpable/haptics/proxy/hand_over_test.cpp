// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A touch that continues while the scene, the radius, the law or the parameters change.
#include "palpable/haptics/law/stroke_scenes.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kT_s = 0.001;

/// A touch whose scene can be changed.
class Touch {
 public:
  explicit Touch(std::shared_ptr<const Touchable> first) {
    device_.mutable_traits().max_force_N = 10.0;
    device_.reading.position.v = {0.0, 0.0, 0.02};
    scenes_.push_back(std::make_unique<HapticScene>(HapticScene{std::move(first), {}, 0}));
    tick_ = std::make_unique<TickPipeline>(device_, *scenes_.back(), TickOptions{}, events_);
    run(400);
  }
  void change(std::shared_ptr<const Touchable> next) {
    ASSERT_FALSE(tick_->fading());
    scenes_.push_back(std::make_unique<HapticScene>(HapticScene{std::move(next), {}, 0}));
    tick_->change(*scenes_.back());
  }
  const TouchSample& run(int ticks) {
    for (int k = 0; k < ticks; ++k) {
      sample_ = &tick_->step(kT_s * static_cast<double>(n_++), kT_s);
      while (events_.take()) {
      }
    }
    return *sample_;
  }
  /// Moves to the target in steps of 0.1 mm.
  const TouchSample& move_to(Vec3 goal) {
    const Vec3 from = device_.reading.position.v;
    const int ticks = 1 + static_cast<int>(norm(goal - from) / 1e-4);
    for (int k = 1; k <= ticks; ++k) {
      device_.reading.position.v = from + (static_cast<double>(k) / ticks) * (goal - from);
      run(1);
    }
    return *sample_;
  }
  bool fading() const { return tick_->fading(); }

 private:
  ScriptedDevice device_;
  std::vector<std::unique_ptr<HapticScene>> scenes_;
  Ring<TouchEvent> events_{64};
  std::unique_ptr<TickPipeline> tick_;
  const TouchSample* sample_ = nullptr;
  std::int64_t n_ = 0;
};

/// A wall 1 mm thick and 8 mm high across x.
models::Scene thin_wall() {
  Raster<float> z(200, 100);
  for (int j = 0; j < z.height(); ++j)
    for (int i = 97; i < 103; ++i) z(i, j) = 0.008F;
  return scene_of(std::move(z));
}

TEST(HandOver, HoldsAHandAtAThinWallWhenTheRadiusChanges) {
  const models::Scene scene = thin_wall();
  LawParameters p = frictionless(0.001);
  Touch touch(made(scene, p));
  touch.move_to({-0.006, 0.0, 0.004});
  // Through the middle of the wall: the proxy stays on the side from which the hand came.
  const Vec3 before = touch.move_to({0.0005, 0.0, 0.004}).written_force_N.v;
  EXPECT_LT(before.x, -0.5);
  for (const double radius_m : {0.00101, 0.001, 0.0011, 0.0}) {
    p.radius_m = radius_m;
    touch.change(made(scene, p));
    for (int k = 0; k < 300; ++k) {
      const TouchSample& sample = touch.run(1);
      ASSERT_TRUE(sample.has(flag::kContact)) << radius_m;
      ASSERT_LT(sample.proxy.v.x, 0.0) << radius_m << " tick " << k;
      ASSERT_LT(sample.written_force_N.v.x, -0.5) << radius_m << " tick " << k;
    }
  }
}

TEST(HandOver, KeepsStaticFrictionWhileTheSurfaceIsUpdated) {
  LawParameters p = frictionless();
  p.static_friction = 0.6;
  p.dynamic_friction = 0.5;
  Touch touch(made(flat_ground(), p));
  touch.move_to({0.0, 0.0, 0.0055});
  touch.move_to({0.0, 0.0, 0.003});
  // Within the friction cone, so the proxy stays at the first contact point.
  const Vec3 proxy = touch.move_to({0.001, 0.0, 0.003}).proxy.v;
  EXPECT_NEAR(proxy.x, 0.0, 1e-9);
  for (int k = 0; k < 30; ++k) {
    // Each update moves the ground by 1 micrometre, so it is a different surface.
    touch.change(made(flat_ground(0.005F + 1e-6F * static_cast<float>(k % 2 + 1)), p));
    touch.run(160);
  }
  EXPECT_NEAR(touch.run(1).proxy.v.x, 0.0, 1e-9) << "nothing creeps";
}

TEST(HandOver, ChangesNothingToTheLastBitWhenTheSurfaceIsTheSame) {
  LawParameters p = frictionless();
  p.static_friction = 0.4;
  const models::Scene scene = scene_of(random_hills(200, 160, 7));
  const double z = models::relief_of(scene)->sample(0.003, 0.002).z_m - 0.001;
  Touch updated(made(scene, p));
  Touch left_alone(made(scene, p));
  for (Touch* touch : {&updated, &left_alone}) touch->move_to({0.003, 0.002, z});
  for (int k = 0; k < 2000; ++k) {
    if (k % 33 == 0 && !updated.fading()) updated.change(made(scene_of(random_hills(200, 160, 7)), p));
    const Vec3 a = updated.run(1).written_force_N.v;
    const Vec3 b = left_alone.run(1).written_force_N.v;
    ASSERT_EQ(a, b) << k;
  }
}

TEST(HandOver, BringsTheProxyFromOneLawToAnother) {
  Raster<float> z(100, 80, 0.005F);
  const models::Scene scene = scene_of(std::move(z));
  LawParameters p = frictionless();
  Touch touch(made(scene, p));
  touch.move_to({0.0, 0.0, 0.006});
  const double before = touch.move_to({0.0, 0.0, 0.003}).written_force_N.v.z;
  p.law = Law::penalty;
  touch.change(made(scene, p));
  for (int k = 0; k < 200; ++k) ASSERT_NEAR(touch.run(1).written_force_N.v.z, before, 1e-6);
  p.law = Law::proxy;
  touch.change(made(scene, p));
  for (int k = 0; k < 200; ++k) ASSERT_NEAR(touch.run(1).written_force_N.v.z, before, 1e-6);
}

TEST(HandOver, HoldsRandomHandsAtAThinWallOfASolidWhenRadiusAndFrictionChange) {
  using Law = FieldProxyLaw<Walls>;
  const auto solid = std::make_shared<const Walls>();
  const auto law_of = [&](double radius_m, double friction) {
    return Law(solid, MaterialMap({kStrokeStiffness_N_per_m, 0.0, friction, friction}), radius_m);
  };
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 1000; ++k) {
    Hand hand;
    Law law = law_of(0.002 * unit(random), unit(random));
    Law::State state{};
    // From the left into and through the wall at x = 0; the hand then stays there.
    const double height_m = 0.003 + 0.003 * unit(random);
    const double held_m = -0.0005 + 0.0015 * unit(random);
    for (double x = -0.0035; x < held_m; x += 2e-4) {
      hand.position = {{x, 0.0, height_m}};
      law.evaluate(hand, state);
    }
    for (int change = 0; change < 5; ++change) {
      const Law next = law_of(0.002 * unit(random), unit(random));
      Law::State taken{};
      next.take_over(law.hand_over(state), taken);
      for (int n = 0; n < 20; ++n) {
        const LawOutput output = next.evaluate(hand, taken);
        ASSERT_TRUE(output.contact) << k;
        ASSERT_LT(output.proxy.v.x, 0.0) << k;
        ASSERT_LT(output.force_N.v.x, 0.0) << k;
      }
      law = next;
      state = taken;
    }
  }
}

}  // namespace
}  // namespace palpable::haptics
