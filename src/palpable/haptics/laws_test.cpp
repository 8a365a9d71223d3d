// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/laws.hpp"

#include "palpable/core/allocations.hpp"
#include "palpable/haptics/probe_path.hpp"
#include "palpable/models/relief_shaping.hpp"

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kPixel_m = 0.0002;

models::Scene scene_of(Raster<float> samples, double pixel_m = kPixel_m) {
  auto relief = models::Relief::from_samples(std::move(samples), pixel_m);
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(*std::move(relief));
  return scene;
}

models::Scene flat_ground(float z_m = 0.005F) { return scene_of(Raster<float>(100, 80, z_m)); }

Raster<float> random_hills(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Raster<float> z(width, height);
  for (int k = 0; k < 40; ++k) {
    const double x = unit(random) * width;
    const double y = unit(random) * height;
    const double s = 4 + 12 * unit(random);
    const double a = 0.006 * (unit(random) - 0.3);
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i)
        z(i, j) += static_cast<float>(a * std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / (2 * s * s)));
  }
  models::limit_slope(z, kPixel_m, 3.0);
  return z;
}

std::shared_ptr<const Touchable> made(const models::Scene& scene, const LawParameters& parameters) {
  auto touchable = make_touchable(scene, parameters);
  EXPECT_TRUE(touchable);
  return touchable ? *touchable : nullptr;
}

LawParameters frictionless(double radius_m = 0.0) {
  LawParameters p;
  p.stiffness_N_per_m = 500.0;
  p.damping_Ns_per_m = 0.0;
  p.static_friction = 0.0;
  p.radius_m = radius_m;
  return p;
}

Feel feel_at(const Touchable& t, TouchState& state, Vec3 p) {
  Hand hand;
  hand.position = {p};
  return t.feel(hand, state);
}

TEST(ProxyLaw, PushesFromFlatGroundWithExactlyTheSpringsForce) {
  for (const double radius_m : {0.0, 0.001}) {
    const auto law = made(flat_ground(), frictionless(radius_m));
    TouchState state;
    feel_at(*law, state, {0, 0, 0.02});
    const Vec3 pressed{0.001, 0, 0.005 + radius_m - 0.002};
    // 15 mm in one tick is farther than a tick looks: the proxy arrives in the next.
    feel_at(*law, state, pressed);
    const Feel feel = feel_at(*law, state, pressed);
    EXPECT_TRUE(feel.contact);
    EXPECT_NEAR(feel.force_N.v.z, 1.0, 0.005);
    EXPECT_NEAR(feel.force_N.v.x, 0.0, 1e-6);
  }
}

TEST(ProxyLaw, IsSilentAboveTheSurface) {
  const auto law = made(scene_of(random_hills(100, 80, 3)), frictionless());
  TouchState state;
  for (double x = -0.02; x < 0.02; x += 0.0003) {
    const Feel feel = feel_at(*law, state, {x, 0.001, 0.02});
    EXPECT_FALSE(feel.contact);
    EXPECT_EQ(norm(feel.force_N), 0.0);
    EXPECT_EQ(feel.proxy.v, (Vec3{x, 0.001, 0.02}));
  }
}

TEST(ProxyLaw, FindsANewTouchUnderTheSurface) {
  const auto law = made(flat_ground(), frictionless());
  TouchState state;
  EXPECT_TRUE(feel_at(*law, state, {0, 0, 0.004}).contact);
}

TEST(ProxyLaw, SticksInsideTheConeAndSlidesOutsideIt) {
  LawParameters p = frictionless();
  p.static_friction = 0.5;
  p.dynamic_friction = 0.4;
  const auto law = made(flat_ground(), p);
  TouchState state;
  feel_at(*law, state, {0, 0, 0.006});
  feel_at(*law, state, {0, 0, 0.003});
  Feel feel = feel_at(*law, state, {0.00099, 0, 0.003});
  EXPECT_NEAR(feel.proxy.v.x, 0.0, 1e-9) << "2 mm deep, the cone is 1 mm wide";
  feel = feel_at(*law, state, {0.0015, 0, 0.003});
  EXPECT_NEAR(feel.proxy.v.x, 0.0015 - 0.4 * 0.002, 1e-6) << "now the dynamic coefficient holds";
  EXPECT_NEAR(-feel.force_N.v.x / feel.force_N.v.z, 0.4, 1e-3);
  const double rests = feel.proxy.v.x;
  for (int k = 0; k < 1000; ++k) feel = feel_at(*law, state, {0.0015, 0, 0.003});
  EXPECT_EQ(feel.proxy.v.x, rests) << "nothing drifts";
  feel = feel_at(*law, state, {rests + 0.00098, 0, 0.003});
  EXPECT_NEAR(feel.proxy.v.x, rests, 1e-9) << "at rest, the static coefficient holds again";
}

TEST(ProxyLaw, KeepsTheForceInTheFrictionConeOnHills) {
  const models::Scene scene = scene_of(random_hills(200, 160, 5));
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  LawParameters p = frictionless();
  p.static_friction = 0.6;
  p.dynamic_friction = 0.3;
  const auto law = made(scene, p);
  TouchState state;
  for (int k = 0; k < 20000; ++k) {
    const double t = 0.001 * k;
    const double x = 0.017 * std::sin(2.0 * t);
    const double y = 0.013 * std::sin(3.1 * t);
    const Feel feel = feel_at(*law, state, {x, y, relief.sample(x, y).z_m - 0.0007});
    if (!feel.contact) continue;
    const auto s = relief.sample(feel.proxy.v.x, feel.proxy.v.y);
    const Vec3 n = unit(Vec3{-s.dzdx, -s.dzdy, 1.0});
    const double normal = dot(feel.force_N.v, n);
    const double along = norm(feel.force_N.v - normal * n);
    ASSERT_GE(normal, -1e-9);
    ASSERT_LE(along, 0.6 * normal + 2e-3);
  }
}

TEST(ProxyLaw, FeelsTheSameWhenSceneAndProbeAreTurnedTogether) {
  const Raster<float> hills = random_hills(120, 120, 7);
  Raster<float> turned(120, 120);
  // A quarter turn to the left: what was at (x, y) comes to (-y, x).
  for (int j = 0; j < 120; ++j)
    for (int i = 0; i < 120; ++i) turned(j, 119 - i) = hills(i, j);
  LawParameters p = frictionless(0.0006);
  p.static_friction = 0.3;
  const auto law = made(scene_of(hills), p);
  const auto law_turned = made(scene_of(turned), p);
  TouchState a;
  TouchState b;
  for (int k = 0; k < 4000; ++k) {
    const double t = 0.001 * k;
    const Vec3 at{0.009 * std::sin(2 * t), 0.008 * std::sin(3 * t + 1), 0.003 + 0.002 * std::sin(5 * t)};
    const Vec3 f = feel_at(*law, a, at).force_N.v;
    const Vec3 g = feel_at(*law_turned, b, {-at.y, at.x, at.z}).force_N.v;
    ASSERT_NEAR(norm(Vec3{-f.y, f.x, f.z} - g), 0.0, 2e-4) << k;
  }
}

TEST(ProxyLaw, MakesNoEnergyRoundClosedLoopsOfAPress) {
  // Without friction and damping the force is the gradient of half the stiffness times the distance squared.
  const models::Scene scene = scene_of(random_hills(200, 160, 11));
  const auto law = made(scene, frictionless());
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  TouchState state;
  double work = 0.0;
  double low = 0.0;
  double high = 0.0;
  Vec3 last{};
  Vec3 last_force{};
  const int n = 200000;
  for (int k = 0; k <= 2 * n; ++k) {
    const double t = 2 * M_PI * k / n;
    const double x = 0.012 * std::sin(t);
    const double y = 0.009 * std::sin(2 * t);
    const Vec3 p{x, y, relief.sample(x, y).z_m - 0.0002 - 0.0001 * std::sin(3 * t)};
    const Vec3 f = feel_at(*law, state, p).force_N.v;
    if (k > n) {
      work += dot(0.5 * (f + last_force), p - last);
      low = std::min(low, work);
      high = std::max(high, work);
    }
    last = p;
    last_force = f;
  }
  EXPECT_LE(std::abs(work), 2e-5 * (high - low));
}

TEST(RollingLaw, DoesNoWorkRoundClosedLoopsWhereSobelDoes) {
  const models::Scene scene = scene_of(random_hills(200, 160, 13));
  const auto net_of = [&](Law kind) {
    LawParameters p;
    p.law = kind;
    p.damping_Ns_per_m = 0.0;
    const auto law = made(scene, p);
    TouchState state;
    double work = 0.0;
    double low = 0.0;
    double high = 0.0;
    Vec3 last{};
    Vec3 last_force{};
    const int n = 400000;
    for (int k = 0; k <= n; ++k) {
      const double t = 2 * M_PI * k / n;
      const Vec3 p_m{0.015 * std::sin(t) + 0.003 * std::sin(3 * t), 0.012 * std::sin(2 * t + 0.3), 0};
      const Vec3 f = feel_at(*law, state, p_m).force_N.v;
      if (k > 0) {
        work += dot(0.5 * (f + last_force), p_m - last);
        low = std::min(low, work);
        high = std::max(high, work);
      }
      last = p_m;
      last_force = f;
    }
    return std::abs(work) / (high - low);
  };
  EXPECT_LE(net_of(Law::rolling), 1e-6);
  EXPECT_GE(net_of(Law::sobel), 1e-3);
}

TEST(RollingLaw, IsTheWeightOfABallOnASlope) {
  Raster<float> plane(60, 60);
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 60; ++i) plane(i, j) = static_cast<float>(0.5 * i * kPixel_m);
  for (const Law kind : {Law::rolling, Law::sobel}) {
    LawParameters p;
    p.law = kind;
    p.stiffness_N_per_m = 2.0;
    p.damping_Ns_per_m = 3.0;
    const auto law = made(scene_of(plane), p);
    TouchState state;
    Hand hand;
    hand.velocity_m_per_s = {{0.1, -0.2, 0.7}};
    const Feel feel = law->feel(hand, state);
    EXPECT_NEAR(feel.force_N.v.x, -2.0 * 0.5 - 3.0 * 0.1, 1e-4);
    EXPECT_NEAR(feel.force_N.v.y, 3.0 * 0.2, 1e-4);
    EXPECT_EQ(feel.force_N.v.z, 0.0);
    EXPECT_TRUE(feel.contact);
    EXPECT_FALSE(feel.has_proxy);
  }
}

TEST(ProxyLaw, DampsAlongTheNormalAndNeverPulls) {
  LawParameters p = frictionless();
  p.damping_Ns_per_m = 2.0;
  const auto law = made(flat_ground(), p);
  TouchState state;
  Hand hand;
  hand.position = {{0, 0, 0.004}};
  hand.velocity_m_per_s = {{0.3, 0, -0.1}};
  const Feel pressing = law->feel(hand, state);
  EXPECT_NEAR(pressing.force_N.v.z, 0.5 + 0.2, 1e-6);
  EXPECT_NEAR(pressing.force_N.v.x, 0.0, 1e-9);
  hand.velocity_m_per_s = {{0, 0, 1.0}};
  EXPECT_EQ(law->feel(hand, state).force_N.v.z, 0.0);
}

TEST(PenaltyLaw, PushesFromFlatGroundAsASpringAndNeverPulls) {
  for (const Law kind : {Law::penalty, Law::averaged})
    for (const auto direction : {PenaltyDirection::gradient, PenaltyDirection::normal}) {
      LawParameters p = frictionless();
      p.law = kind;
      p.damping_Ns_per_m = 2.0;
      p.penalty = direction;
      const auto law = made(flat_ground(), p);
      TouchState state;
      EXPECT_NEAR(feel_at(*law, state, {0.001, 0, 0.003}).force_N.v.z, 1.0, 1e-6);
      EXPECT_FALSE(feel_at(*law, state, {0.001, 0, 0.0051}).contact);
      Hand hand;
      hand.position = {{0, 0, 0.004}};
      hand.velocity_m_per_s = {{0, 0, 1.0}};
      EXPECT_EQ(law->feel(hand, state).force_N.v.z, 0.0);
    }
}

TEST(PenaltyLaw, IsTheExactGradientOfItsPotential) {
  const models::Scene scene = scene_of(random_hills(200, 160, 29));
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  LawParameters p = frictionless();
  p.law = Law::penalty;
  const auto law = made(scene, p);
  TouchState state;
  const auto energy = [&](Vec3 at) {
    const auto s = relief.sample(at.x, at.y);
    const double d = (s.z_m - at.z) / std::sqrt(1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy);
    return 0.5 * 500.0 * d * d;
  };
  for (int k = 0; k < 500; ++k) {
    const double x = 0.015 * std::sin(0.7 * k);
    const double y = 0.011 * std::sin(1.1 * k);
    const Vec3 at{x, y, relief.sample(x, y).z_m - 0.001};
    const Vec3 f = feel_at(*law, state, at).force_N.v;
    // Far above the rounding of a look, 1e-10 m, and far below a pixel.
    const double e = 1e-7;
    ASSERT_NEAR(f.x, -(energy(at + Vec3{e, 0, 0}) - energy(at - Vec3{e, 0, 0})) / (2 * e), 1e-3);
    ASSERT_NEAR(f.y, -(energy(at + Vec3{0, e, 0}) - energy(at - Vec3{0, e, 0})) / (2 * e), 1e-3);
    ASSERT_NEAR(f.z, -(energy(at + Vec3{0, 0, e}) - energy(at - Vec3{0, 0, e})) / (2 * e), 1e-3);
  }
}

TEST(AveragedLaw, WithAllWeightAtTheCentreIsTheShadedPenalty) {
  const models::Scene scene = scene_of(random_hills(200, 160, 31));
  LawParameters p = frictionless();
  p.law = Law::averaged;
  p.averaging = {0.001, 0.0, 3.0};
  const auto averaged = made(scene, p);
  p.law = Law::penalty;
  p.penalty = PenaltyDirection::normal;
  const auto penalty = made(scene, p);
  TouchState state;
  for (int k = 0; k < 300; ++k) {
    const Vec3 at{0.015 * std::sin(0.7 * k), 0.011 * std::sin(1.1 * k), 0.0};
    ASSERT_NEAR(norm(feel_at(*averaged, state, at).force_N - feel_at(*penalty, state, at).force_N), 0.0,
                1e-12);
  }
}

TEST(ProxyLaw, TakesEachRegionsMaterial) {
  models::Scene scene = flat_ground();
  models::Material soft;
  soft.stiffness_N_per_m = 100.0;
  soft.static_friction = soft.dynamic_friction = soft.damping_Ns_per_m = 0.0;
  models::Material hard = soft;
  hard.stiffness_N_per_m = 800.0;
  scene.materials = {soft, hard};
  scene.labels = Raster<std::uint8_t>(100, 80);
  for (int j = 0; j < 80; ++j)
    for (int i = 50; i < 100; ++i) scene.labels(i, j) = 1;
  const auto law = made(scene, {});
  TouchState state;
  feel_at(*law, state, {-0.005, 0, 0.006});
  Feel feel = feel_at(*law, state, {-0.005, 0, 0.004});
  EXPECT_NEAR(feel.force_N.v.z, 0.1, 1e-6);
  EXPECT_EQ(feel.label, 0);
  double last = feel.force_N.v.z;
  for (int k = 0; k < 200; ++k) {
    feel = feel_at(*law, state, {-0.005 + 0.00005 * k, 0, 0.004});
    EXPECT_LT(std::abs(feel.force_N.v.z - last), 0.08) << "a border is no kick";
    last = feel.force_N.v.z;
  }
  EXPECT_EQ(feel.label, 1);
  EXPECT_NEAR(feel.force_N.v.z, 0.8, 0.01);
}

TEST(Laws, ContinueEachOthersStateOnlyOnTheSameSurface) {
  const models::Scene scene = flat_ground();
  LawParameters p = frictionless();
  const auto family = made(scene, p)->state_family();
  p.stiffness_N_per_m = 900.0;
  EXPECT_EQ(made(flat_ground(), p)->state_family(), family);
  p.radius_m = 0.001;
  EXPECT_NE(made(scene, p)->state_family(), family);
  EXPECT_NE(made(flat_ground(0.006F), frictionless())->state_family(), family);
}

TEST(Laws, RefuseParametersOutOfTheirRange) {
  for (const double bad : {0.0, -1.0, 1e9, std::nan("")}) {
    LawParameters p;
    p.stiffness_N_per_m = bad;
    const auto refused = make_touchable(flat_ground(), p);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
  }
  LawParameters p;
  p.radius_m = 0.5;
  EXPECT_FALSE(make_touchable(flat_ground(), p));
}

TEST(Laws, NeverAllocateInATick) {
  ASSERT_TRUE(allocations_are_counted());
  const models::Scene scene = scene_of(random_hills(100, 80, 23));
  for (const Law kind : laws_for(scene)) {
    LawParameters p;
    p.law = kind;
    p.radius_m = 0.0005;
    const auto law = made(scene, p);
    TouchState state;
    std::uint64_t contacts = 0;
    const AllocationScope scope;
    for (int k = 0; k < 20000; ++k)
      contacts +=
          feel_at(*law, state,
                  {0.013 * std::sin(0.003 * k), 0.01 * std::sin(0.005 * k), 0.002 * std::sin(0.02 * k)})
                  .contact
              ? 1U
              : 0U;
    EXPECT_EQ(scope.count(), 0U) << name_of(kind);
    EXPECT_GT(contacts, 5000U);
  }
}

TEST(Laws, HaveNamesThatLeadBack) {
  for (const Law law : {Law::rolling, Law::sobel, Law::proxy, Law::penalty, Law::averaged})
    EXPECT_EQ(law_from(name_of(law)), law);
  EXPECT_FALSE(law_from("no such law"));
}

TEST(ProbePath, GivesTheSameForcesEachTimeAndChecksItsInput) {
  const models::Scene scene = scene_of(random_hills(100, 80, 17));
  const auto law = made(scene, {});
  std::vector<PathSample> path;
  for (int k = 0; k < 3000; ++k)
    path.push_back({0.001 * k, {{0.008 * std::sin(0.004 * k), 0.006 * std::sin(0.007 * k), 0.002}}});
  ASSERT_TRUE(check_path(path));
  std::vector<Vec3> first;
  probe_path(*law, path, [&](const PathSample&, const Feel& f) { first.push_back(f.force_N.v); });
  std::size_t at = 0;
  probe_path(*law, path, [&](const PathSample&, const Feel& f) { EXPECT_EQ(f.force_N.v, first[at++]); });
  EXPECT_EQ(at, path.size());
  const TickTimes times = time_path(*law, path);
  EXPECT_EQ(times.latency.count, path.size());
  EXPECT_GT(times.latency.p50_ns, 0.0);
  path[7].t_s = path[6].t_s;
  EXPECT_FALSE(check_path(path));
  path[7].t_s = std::nan("");
  EXPECT_FALSE(check_path(path));
}

}  // namespace
}  // namespace palpable::haptics
