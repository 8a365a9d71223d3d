// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Hands that press on a thin crest or a flat top and slip off it, into the air beside it.
#include "palpable/haptics/law/stroke_scenes.hpp"
#include "palpable/haptics/law/test_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

struct SlippedHands {
  int in_air = 0;
  int held = 0;
};

/// Hands that move from above a crest at `top_m` along x = 0 down beside it and wait there.
template <class Height>
SlippedHands slip_off(const Touchable& touchable, double top_m, Height height_over) {
  std::mt19937 random(3);
  const auto uniform = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  SlippedHands hands;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 from{uniform(-1e-4, 1e-4), 0.0, top_m + 0.0005};
    const Vec3 to{uniform(-0.0015, 0.0015), 0.0, top_m - uniform(0.0005, 0.0045)};
    if (height_over(to) < 1e-5) continue;
    const int ticks = std::uniform_int_distribution<int>(10, 70)(random);
    TouchState state;
    LawOutput output;
    for (int n = 0; n < ticks + 50; ++n)
      output = output_at(touchable, state, from + std::min(1.0, 1.0 * n / ticks) * (to - from));
    ++hands.in_air;
    hands.held += norm(output.force_N) > 1e-3 ? 1 : 0;
  }
  return hands;
}

TEST(Crest, OfASolidHoldsNoHandInTheAirBesideIt) {
  for (const double friction : {0.0, 0.5, 1.0}) {
    const SlippedHands hands = slip_off(SolidTouchable<Walls>(friction), 0.009,
                                        [](Vec3 p) { return Walls().sample({p}).distance_m; });
    EXPECT_GT(hands.in_air, 500);
    EXPECT_EQ(hands.held, 0) << friction;
  }
}

TEST(Crest, OfAReliefHoldsNoMoreHandsByFrictionThanWithoutIt) {
  Raster<float> z(200, 160, 0.001F);
  for (int y = 0; y < z.height(); ++y) z(99, y) = z(100, y) = 0.008F;
  models::limit_slope(z, kPixel_m, 10.0);
  const models::Scene scene = scene_of(std::move(z));
  const auto relief = models::relief_of(scene);
  int without = 0;
  for (const double friction : {0.0, 0.5, 1.0}) {
    LawParameters parameters = frictionless();
    parameters.static_friction = friction;
    const SlippedHands hands = slip_off(*made(scene, parameters), relief->sample(0.0, 0.0).z_m,
                                        [&](Vec3 p) { return p.z - relief->sample(p.x, p.y).z_m; });
    EXPECT_GT(hands.in_air, 500);
    if (friction == 0.0) without = hands.held;
    EXPECT_LE(hands.held, without) << friction;
  }
  // Deep beside it, a few wait at a place from which no step on the surface is nearer.
  EXPECT_LE(without, 10);
}

/// Ground of random heights up to 8 mm, nearly as steep as a relief may be.
models::Scene rugged_ground(double pixel_m, std::mt19937& random) {
  Raster<float> z(static_cast<int>(0.03 / pixel_m), static_cast<int>(0.02 / pixel_m));
  std::uniform_real_distribution<float> height(0.0F, 0.008F);
  for (int j = 0; j < z.height(); ++j)
    for (int i = 0; i < z.width(); ++i) z(i, j) = height(random);
  models::limit_slope(z, pixel_m, 100.0);
  return scene_of(std::move(z), pixel_m);
}

/// Clear ticks of hands that plough through rugged ground and come out of it, and those of them with force.
struct PloughedAir {
  int clear = 0;
  int pushed = 0;
  /// The same where the hand is above the highest ground.
  int above = 0;
  int pushed_above = 0;
};

PloughedAir plough(double pixel_m, double friction, double speed_m_per_s, std::mt19937& random) {
  const models::Scene scene = rugged_ground(pixel_m, random);
  const auto relief = models::relief_of(scene);
  LawParameters parameters = frictionless();
  parameters.static_friction = friction;
  const auto law = made(scene, parameters);
  const auto uniform = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  // A surface through these heights overshoots them by less than a millimetre.
  constexpr double kTop_m = 0.009;
  const auto over = [&](Vec3 p) { return p.z - relief->sample(p.x, p.y).z_m; };
  PloughedAir air;
  for (int k = 0; k < 20; ++k) {
    TouchState state;
    Vec3 last{uniform(-0.01, 0.0), uniform(-0.005, 0.005), kTop_m + 0.001};
    output_at(*law, state, last);
    double rises = -0.5;
    for (int n = 0; n < 400; ++n) {
      if (last.z < kTop_m - 0.003) rises = 0.5;
      if (last.z > kTop_m + 0.002) rises = -0.5;
      const Vec3 p = last + speed_m_per_s * 0.001 * unit(Vec3{uniform(-1.0, 1.2), uniform(-1.0, 1.0), rises});
      const double force_N = norm(output_at(*law, state, p).force_N);
      bool is_clear = true;
      for (int part = 0; part <= 16; ++part)
        is_clear = is_clear && over(last + part / 16.0 * (p - last)) > 2e-5;
      const bool is_above = std::min(last.z, p.z) > kTop_m;
      air.clear += is_clear ? 1 : 0;
      air.pushed += is_clear && force_N > 1e-3 ? 1 : 0;
      air.above += is_above ? 1 : 0;
      air.pushed_above += is_above && force_N > 0.0 ? 1 : 0;
      last = p;
    }
  }
  return air;
}

TEST(Crest, AHandThatPloughedThroughRuggedGroundIsLetGoAboveIt) {
  std::mt19937 random(5);
  for (const double friction : {0.0, 0.3}) {
    PloughedAir all;
    for (const double pixel_m : {0.00005, 0.0001, 0.00025})
      for (const double speed_m_per_s : {0.1, 0.5, 2.0}) {
        const PloughedAir air = plough(pixel_m, friction, speed_m_per_s, random);
        EXPECT_EQ(air.pushed_above, 0) << pixel_m << ", " << speed_m_per_s;
        all.clear += air.clear;
        all.pushed += air.pushed;
        all.above += air.above;
      }
    EXPECT_GT(all.above, 1000);
    EXPECT_LE(all.pushed, all.clear / 100) << "of " << all.clear << ", friction " << friction;
  }
}

/// A flat top, 12 mm wide and 6 mm high, with sides of the slope `steepest`.
models::Scene flat_top(double pixel_m, double steepest) {
  constexpr double kHalf_m = 0.006;
  Raster<float> z(static_cast<int>(0.04 / pixel_m), static_cast<int>(0.02 / pixel_m));
  for (int j = 0; j < z.height(); ++j)
    for (int i = 0; i < z.width(); ++i)
      z(i, j) = std::abs(i - 0.5 * z.width()) * pixel_m < kHalf_m ? 0.006F : 0.0F;
  models::limit_slope(z, pixel_m, steepest);
  return scene_of(std::move(z), pixel_m);
}

TEST(Crest, AHandThatSlipsOffAFlatTopIsLetGoInItsFirstTickInTheAir) {
  std::mt19937 random(4);
  const auto uniform = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  int clear = 0, pushed = 0, pressed = 0;
  for (const double pixel_m : {0.0001, 0.0003, 0.001, 0.002})
    for (const double steepest : {3.0, 40.0})
      for (const double friction : {0.0, 0.3, 1.0}) {
        const models::Scene scene = flat_top(pixel_m, steepest);
        const auto relief = models::relief_of(scene);
        LawParameters parameters = frictionless();
        parameters.static_friction = friction;
        const auto law = made(scene, parameters);
        const auto over = [&](Vec3 p) { return p.z - relief->sample(p.x, p.y).z_m; };
        for (int k = 0; k < 20; ++k) {
          // Pressed into the top, then out through its side.
          const Vec3 above{uniform(0.0, 0.004), uniform(-0.005, 0.005), 0.0065};
          const Vec3 deep = above - Vec3{0.0, 0.0, uniform(0.001, 0.004)};
          const Vec3 step = std::pow(10.0, uniform(-4.5, -2.7)) * unit(Vec3{1.0, uniform(-0.5, 0.5), 0.0});
          TouchState state;
          for (int n = 0; n <= 20; ++n) output_at(*law, state, above + n / 20.0 * (deep - above));
          Vec3 last = deep;
          for (int n = 0; n < 400 && last.x < 0.012; ++n) {
            const Vec3 p = last + step;
            const double force_N = norm(output_at(*law, state, p).force_N);
            const bool is_clear = over(last) > 1e-6 && over(p) > 1e-6;
            clear += is_clear ? 1 : 0;
            pushed += is_clear && force_N > 0.0 ? 1 : 0;
            pressed += over(p) < -1e-6 && force_N > 0.0 ? 1 : 0;
            last = p;
          }
        }
      }
  EXPECT_EQ(pushed, 0) << "of " << clear;
  EXPECT_GT(clear, 2000);
  EXPECT_GT(pressed, 10000);
}

}  // namespace
}  // namespace palpable::haptics
