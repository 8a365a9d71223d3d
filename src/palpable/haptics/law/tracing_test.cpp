// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/tracing.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/law/test_period.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// A boundary along x through the whole map, strongest at y = 0.
std::shared_ptr<const models::BoundaryMap> straight_boundary(double angle = 0.0, double pixel_m = 0.0005) {
  Raster<models::BoundaryPixel> pixels(
      200, 200,
      {static_cast<float>(0.8 * std::cos(2 * angle)), static_cast<float>(0.8 * std::sin(2 * angle))});
  return std::make_shared<const models::BoundaryMap>(
      *models::BoundaryMap::from_edges(std::move(pixels), pixel_m, 1.0, {}, Work{}));
}

/// Moves the hand in steps and returns the output of every tick.
std::vector<LawOutput> traced(const TracingLaw& law, TracingLaw::State& state,
                              const std::vector<Vec3>& path) {
  std::vector<LawOutput> felt;
  Vec3 before = path.front();
  for (const Vec3 p : path) {
    felt.push_back(law.evaluate({{p}, {(p - before) / kT_s}, kT_s}, state));
    before = p;
  }
  return felt;
}

std::vector<Vec3> straight_path(Vec3 from, Vec3 velocity_m_per_s, int ticks) {
  std::vector<Vec3> path;
  for (int k = 0; k < ticks; ++k) path.push_back(from + k * kT_s * velocity_m_per_s);
  return path;
}

TracingParameters undamped() {
  TracingParameters p;
  p.damping_Ns_per_m = 0.0;
  return p;
}

TEST(Tracing, HelpsAlongTheBoundaryBothWays) {
  const TracingLaw law(straight_boundary(), undamped());
  for (const double way : {1.0, -1.0}) {
    TracingLaw::State state{};
    const LawOutput last = traced(law, state, straight_path({}, {0.05 * way, 0, 0}, 200)).back();
    EXPECT_NEAR(last.force_N.v.x * way, 0.8, 0.01);
    EXPECT_NEAR(last.force_N.v.y, 0.0, 1e-9);
  }
}

TEST(Tracing, DoesNothingToAHandThatCrossesAtARightAngle) {
  const TracingLaw law(straight_boundary(), undamped());
  TracingLaw::State state{};
  for (const LawOutput& f : traced(law, state, straight_path({0.001, -0.02, 0}, {0, 0.05, 0}, 800)))
    EXPECT_LT(norm(f.force_N), 1e-9);
}

TEST(Tracing, WithoutItsBoundsIsEquation8AsItIsPrinted) {
  // Back and forth along a boundary, with a rest at the end: F_m (d·t) |b| t with d of eqs 5 and 6, in every
  // tick.
  TracingParameters printed = undamped();
  printed.is_bounded = false;
  const TracingLaw law(straight_boundary(), printed), ours(straight_boundary(), undamped());
  std::vector<Vec3> path;
  for (int k = 0; k < 4000; ++k) path.push_back({0.01 * std::sin(0.01 * k), 0.0, 0.0});
  path.insert(path.end(), 200, path.back());
  TracingLaw::State state{}, our_state{};
  double mean_N = 0.0, our_mean_N = 0.0, w = path.front().x;
  const auto felt = traced(law, state, path), ours_felt = traced(ours, our_state, path);
  for (std::size_t k = 0; k < path.size(); ++k) {
    w = std::clamp(w, path[k].x - printed.direction_m, path[k].x + printed.direction_m);
    const double direction = (path[k].x - w) / printed.direction_m;
    ASSERT_NEAR(felt[k].force_N.v.x, 0.8 * direction, 1e-6) << k;
    mean_N += std::abs(felt[k].force_N.v.x) / static_cast<double>(path.size());
    our_mean_N += std::abs(ours_felt[k].force_N.v.x) / static_cast<double>(path.size());
  }
  EXPECT_GT(mean_N, 0.5);
  EXPECT_LT(our_mean_N, 0.5 * mean_N);
  EXPECT_GT(std::abs(felt.back().force_N.v.x), 0.5);
  EXPECT_NEAR(ours_felt.back().force_N.v.x, 0.0, 1e-6);
  EXPECT_EQ(law.energy_model(), EnergyModel::none);
}

TEST(Tracing, LetsAHandRest) {
  TracingParameters strong = undamped();
  strong.force_N = 5.0;
  const TracingLaw law(straight_boundary(), strong);
  TracingLaw::State state{};
  auto path = straight_path({}, {0.05, 0, 0}, 200);
  const Vec3 stop = path.back();
  std::mt19937 random(3);
  // A hand at rest on a sensor with a resolution of 20 um: the last digit changes now and then, and the hand
  // drifts at 0.4 mm/s.
  for (int k = 0; k < 2000; ++k) {
    const double x = stop.x + 0.0004 * k * kT_s;
    path.push_back({std::round(x / 2e-5) * 2e-5, stop.y, 0});
  }
  const auto felt = traced(law, state, path);
  for (std::size_t k = 700; k < felt.size(); ++k) EXPECT_LE(norm(felt[k].force_N), 0.001) << k;
}

TEST(Tracing, HasNoForceAtTheSpeedCap) {
  const TracingLaw law(straight_boundary(), undamped());
  TracingLaw::State state{};
  const auto felt = traced(law, state, straight_path({-0.045, 0, 0}, {0.3, 0, 0}, 280));
  EXPECT_LT(norm(felt.back().force_N), 1e-9);
}

TEST(Tracing, NeverDeliversMoreThanItsTank) {
  // A hand guided along the boundary for a long time, as fast as the law assists: energy given <= tank +
  // refill.
  TracingParameters strong = undamped();
  strong.force_N = 5.0;
  const TracingLaw law(straight_boundary(0.0, 0.005), strong);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> speed(0.0, 0.3);
  TracingLaw::State state{};
  Vec3 p{};
  Vec3 before = p;
  Vec3 force{};
  double v = 0.1;
  double given_J = 0.0;
  for (int k = 1; k <= 20000; ++k) {
    if (k % 97 == 0) v = std::copysign(speed(random), v);
    if (std::abs(p.x + v * kT_s) > 0.45) v = -v;
    p.x += v * kT_s;
    given_J += dot(force, p - before);
    force = law.evaluate({{p}, {(p - before) / kT_s}, kT_s}, state).force_N.v;
    before = p;
    ASSERT_GE(TracingLaw::kTank_J - state.spent_J, 0.0);
    ASSERT_LE(given_J, TracingLaw::kTank_J + TracingLaw::kRefill_W * k * kT_s + 1e-9);
  }
  EXPECT_GT(given_J, 0.1);
}

/// An arm, modelled as a mass on a spring attached to the middle of the boundary, is released at a distance:
/// its final speed.
double speed_left(const TracingLaw& law, double mass_kg, double hertz, double damping_ratio, double at_m) {
  const double omega = 2.0 * std::numbers::pi * hertz;
  TracingLaw::State state{};
  double x = at_m, v = 0.0;
  for (int k = 0; k < 15000; ++k) {
    const double push_N = law.evaluate({{{x, 0, 0}}, {{v, 0, 0}}, kT_s}, state).force_N.v.x;
    v += kT_s * (push_N / mass_kg - 2.0 * damping_ratio * omega * v - omega * omega * x);
    x += kT_s * v;
  }
  return std::abs(v);
}

TEST(Tracing, DoesNotSustainOscillationsAboutAnAim) {
  for (const double force_N : {1.0, 5.0}) {
    TracingParameters p;
    p.force_N = force_N;
    const TracingLaw law(straight_boundary(), p);
    for (const double mass_kg : {0.3, 1.0, 2.0})
      for (const double hertz : {0.8, 1.5, 3.0, 6.0})
        for (const double damping_ratio : {0.1, 0.3})
          EXPECT_LT(speed_left(law, mass_kg, hertz, damping_ratio, 0.01), 0.001)
              << force_N << " N, " << mass_kg << " kg, " << hertz << " Hz, " << damping_ratio;
  }
}

TEST(Tracing, PushesAgainSoonAfterAReversal) {
  const TracingLaw law(straight_boundary(), undamped());
  TracingLaw::State state{};
  traced(law, state, straight_path({}, {0.05, 0, 0}, 200));
  const auto back = traced(law, state, straight_path({0.01, 0, 0}, {-0.02, 0, 0}, 1200));
  EXPECT_NEAR(back[800].force_N.v.x, 0.0, 1e-9);
  EXPECT_LT(back[1199].force_N.v.x, -0.7);
}

TEST(Tracing, HoldsAHandOfThreeAxesInFrontOfThePicture) {
  const TracingLaw law(straight_boundary(), undamped());
  TracingLaw::State state{};
  EXPECT_NEAR(law.evaluate({{{0, 0, -0.002}}, {}, kT_s}, state).force_N.v.z, 0.3, 1e-12);
  EXPECT_EQ(law.evaluate({{{0, 0, 0.002}}, {}, kT_s}, state).force_N.v.z, 0.0);
}

models::Scene contours_scene() {
  models::Scene scene;
  scene.model = std::make_shared<const models::Contours>(models::Contours{
      *straight_boundary(), std::make_shared<const models::Relief>(
                                *models::Relief::from_samples(Raster<float>(50, 50, 0.001F), 0.002))});
  return scene;
}

TEST(Tracing, IsTheDefaultLawOfContours) {
  const auto laws = laws_for(contours_scene());
  ASSERT_EQ(laws, (std::vector{Law::tracing, Law::groove, Law::rolling}));
  for (const Law law : laws) {
    LawParameters parameters;
    parameters.law = law;
    EXPECT_TRUE(make_touchable(contours_scene(), parameters)) << name_of(law);
  }
  LawParameters proxy;
  EXPECT_EQ(make_touchable(contours_scene(), proxy).error().code, ErrorCode::usage);
}

TEST(Tracing, TakesItsForceAndNeighbourhoodLive) {
  const auto pushed = [](double force_N) {
    LawParameters p;
    p.law = Law::tracing;
    p.tracing_force_N = force_N;
    p.damping_Ns_per_m = 0.0;
    p.neighbourhood_px = 5.0;
    const auto touchable = make_touchable(contours_scene(), p);
    TouchState state;
    LawOutput output;
    for (int k = 0; k < 200; ++k)
      output = (*touchable)->evaluate({{{0.05 * k * kT_s, 0, 0}}, {{0.05, 0, 0}}, kT_s}, state);
    return output.force_N.v.x;
  };
  EXPECT_NEAR(pushed(2.0), 2.0 * pushed(1.0), 1e-9);
  LawParameters wide;
  wide.law = Law::tracing;
  wide.neighbourhood_px = 100.0;
  EXPECT_FALSE(make_touchable(contours_scene(), wide));
}

TEST(Tracing, AllocatesNothingInATick) {
  const TracingLaw law(straight_boundary(0.4), {});
  TracingLaw::State state{};
  ASSERT_TRUE(allocations_are_counted());
  const AllocationScope scope;
  for (int k = 0; k < 1000; ++k) law.evaluate({{{0.00001 * k, 0.0001, 0}}, {{0.01, 0, 0}}, kT_s}, state);
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::haptics
