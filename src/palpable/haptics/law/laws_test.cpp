// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/laws.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/haptics/law/rolling.hpp"
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/servo/probe_path.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

TEST(RollingLaw, DoesNoWorkOnClosedPathsWhereSobelDoes) {
  const models::Scene scene = scene_of(random_hills(200, 160, 13));
  const auto net_of = [&](Law kind) {
    LawParameters p;
    p.law = kind;
    p.damping_Ns_per_m = 0.0;
    const LoopWork loop = work_round(*made(scene, p), 400000, 0, [](double t) {
      return Vec3{0.015 * std::sin(t) + 0.003 * std::sin(3 * t), 0.012 * std::sin(2 * t + 0.3), 0};
    });
    return std::abs(loop.net_J) / loop.swing_J;
  };
  EXPECT_LE(net_of(Law::rolling), 1e-6);
  EXPECT_GE(net_of(Law::sobel), 1e-3);
}

TEST(RollingLaw, FitsItsSurfaceAndForceToTheBounds) {
  Raster<float> walls(120, 90, 0.005F);
  for (int y = 0; y < walls.height(); ++y) walls(60, y) = 0.009F;
  const models::Scene scene = scene_of(std::move(walls));
  const auto load = [&](const RollingFit& fit, const RollingBounds& bounds) {
    LawParameters p;
    p.law = Law::rolling;
    p.slope_force_N = fit.slope_force_N;
    p.rolling_smoothing_m = fit.smoothing_m;
    p.damping_Ns_per_m = 0.0;
    const auto law = made(scene, p);
    double most = 0.0, before_N = 0.0;
    constexpr double kStep_m = 2e-5;
    for (double x = -0.01; x < 0.01; x += kStep_m) {
      TouchState state;
      Hand hand;
      hand.position.v.x = x;
      const double force_N = law->evaluate(hand, state).force_N.v.x;
      const double bend_N_per_m = x > -0.01 ? std::abs(force_N - before_N) / kStep_m : 0.0;
      most = std::max(
          {most, std::abs(force_N) / bounds.max_force_N, bend_N_per_m / bounds.max_stiffness_N_per_m});
      before_N = force_N;
    }
    return most;
  };
  const RollingFit wanted{1.0, 0.0};
  const RollingBounds wide{1e9, 1e9}, usual{300.0, 3.3}, narrow{5.0, 3.3};
  EXPECT_EQ(fit_rolling(scene, wanted, wide).smoothing_m, 0.0);
  EXPECT_EQ(fit_rolling(scene, wanted, wide).slope_force_N, 1.0);
  ASSERT_GT(load(wanted, usual), 10.0);
  const RollingFit smoothed = fit_rolling(scene, wanted, usual);
  EXPECT_EQ(smoothed.slope_force_N, 1.0);
  EXPECT_LE(load(smoothed, usual), 1.0 + 1e-3);
  EXPECT_GE(load(smoothed, usual), 0.5) << "no smoother than necessary";
  const RollingFit weaker = fit_rolling(scene, wanted, narrow);
  EXPECT_LT(weaker.slope_force_N, 1.0);
  EXPECT_LE(weaker.smoothing_m, kMostRollingSmoothing_m);
  EXPECT_LE(load(weaker, narrow), 1.0 + 1e-3);
}

TEST(RollingLaw, IsTheWeightOfABallOnASlope) {
  Raster<float> plane(60, 60);
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 60; ++i) plane(i, j) = static_cast<float>(0.5 * i * kPixel_m);
  for (const Law kind : {Law::rolling, Law::sobel}) {
    LawParameters p;
    p.law = kind;
    p.slope_force_N = 2.0;
    p.damping_Ns_per_m = 3.0;
    const auto law = made(scene_of(plane), p);
    TouchState state;
    Hand hand;
    hand.velocity_m_per_s = {{0.1, -0.2, 0.7}};
    const LawOutput output = law->evaluate(hand, state);
    EXPECT_NEAR(output.force_N.v.x, -2.0 * 0.5 - 3.0 * 0.1, 1e-4);
    EXPECT_NEAR(output.force_N.v.y, 3.0 * 0.2, 1e-4);
    EXPECT_EQ(output.force_N.v.z, 0.0);
    EXPECT_TRUE(output.contact);
    EXPECT_FALSE(output.has_proxy);
  }
}

TEST(PenaltyLaw, PushesFromFlatGroundAsASpringAndNeverPulls) {
  for (const Law kind : {Law::penalty, Law::averaged})
    for (const double shading : {0.0, 1.0}) {
      LawParameters p = frictionless();
      p.law = kind;
      p.damping_Ns_per_m = 2.0;
      p.force_shading = shading;
      const auto law = made(flat_ground(), p);
      TouchState state;
      EXPECT_NEAR(output_at(*law, state, {0.001, 0, 0.003}).force_N.v.z, 1.0, 1e-6);
      EXPECT_FALSE(output_at(*law, state, {0.001, 0, 0.0051}).contact);
      Hand hand;
      hand.position = {{0, 0, 0.004}};
      hand.velocity_m_per_s = {{0, 0, 1.0}};
      EXPECT_EQ(law->evaluate(hand, state).force_N.v.z, 0.0);
    }
}

TEST(AveragedLaw, WithAllWeightAtTheCentreIsThePapersSpringToTheTangentPlane) {
  const models::Scene scene = scene_of(random_hills(200, 160, 31));
  const auto& relief = *models::relief_of(scene);
  LawParameters p = frictionless();
  p.law = Law::averaged;
  p.neighbour_weight = 0.0;
  p.centre_weight = 3.0;
  const auto averaged = made(scene, p);
  TouchState state;
  for (int k = 0; k < 300; ++k) {
    const Vec3 at{0.015 * std::sin(0.7 * k), 0.011 * std::sin(1.1 * k), 0.0};
    const auto s = relief.sample(at.x, at.y);
    const Vec3 up{-s.dzdx, -s.dzdy, 1.0};
    const Vec3 expected = std::max(0.0, 500.0 * s.z_m / squared_norm(up)) * up;
    ASSERT_NEAR(norm(output_at(*averaged, state, at).force_N.v - expected), 0.0, 1e-9);
  }
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

TEST(Laws, AreInterruptedWhileTheBallRollsOverTheRelief) {
  LawParameters p;
  p.radius_m = 0.001;
  std::atomic<bool> cancel = true;
  Work work;
  work.cancel = &cancel;
  const auto refused = make_touchable(flat_ground(), p, nullptr, work);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::interrupted);
  cancel = false;
  std::vector<double> fractions;
  work.progress = [&fractions](double fraction, std::string_view) { fractions.push_back(fraction); };
  EXPECT_TRUE(make_touchable(flat_ground(), p, nullptr, work));
  ASSERT_FALSE(fractions.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST(Laws, RefuseASceneWithoutAModel) {
  const auto refused = make_touchable(models::Scene{}, LawParameters{});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "the scene has no model");
}

TEST(Laws, RefuseEachOfTheirParametersOutsideTheRangeThatTheyDescribe) {
  const models::Scene scene = flat_ground();
  for (const Law law : laws_for(scene))
    for (const LawParameter& parameter : description_of(law).parameters) {
      LawParameters p;
      p.law = law;
      for (const double valid : {parameter.min, parameter.max, parameter.slider_min, parameter.slider_max}) {
        p.*parameter.value = valid;
        EXPECT_TRUE(make_touchable(scene, p)) << name_of(law) << " " << parameter.name << " " << valid;
      }
      for (const double bad : {parameter.min - 1.0, 1.1 * parameter.max, std::nan("")}) {
        p.*parameter.value = bad;
        const auto refused = make_touchable(scene, p);
        ASSERT_FALSE(refused) << name_of(law) << " " << parameter.name << " " << bad;
        EXPECT_NE(refused.error().message.find(parameter.name), std::string::npos);
      }
    }
}

TEST(Laws, AreDescribedCompletely) {
  for (const LawDescription* law : all_laws()) {
    EXPECT_FALSE(law->name.empty() || law->title.empty() || law->paper.empty());
    ASSERT_NE(find_parameter(*law, law->strength), nullptr) << law->name;
    EXPECT_EQ(law->is_contact, find_parameter(*law, &LawParameters::stiffness_N_per_m) != nullptr)
        << law->name;
    for (const LawParameter& parameter : law->parameters) {
      EXPECT_FALSE(parameter.name.empty() || parameter.title.empty()) << law->name;
      EXPECT_LE(parameter.min, parameter.slider_min);
      EXPECT_LE(parameter.slider_max, parameter.max);
    }
  }
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
          output_at(*law, state,
                    {0.013 * std::sin(0.003 * k), 0.01 * std::sin(0.005 * k), 0.002 * std::sin(0.02 * k)})
                  .contact
              ? 1U
              : 0U;
    EXPECT_EQ(scope.count(), 0U) << name_of(kind);
    EXPECT_GT(contacts, 5000U);
  }
}

TEST(Laws, HaveNamesThatLeadBack) {
  for (const LawDescription* law : all_laws()) {
    EXPECT_EQ(law_from(law->name), law->law);
    EXPECT_EQ(&description_of(law->law), law);
  }
  EXPECT_FALSE(law_from("no such law"));
}

TEST(ProbePath, GivesTheSameForcesEachTimeAndChecksItsInput) {
  const models::Scene scene = scene_of(random_hills(100, 80, 17));
  const auto law = made(scene, {});
  std::vector<PathSample> path;
  path.reserve(3000);
  for (int k = 0; k < 3000; ++k)
    path.push_back({0.001 * k, {{0.008 * std::sin(0.004 * k), 0.006 * std::sin(0.007 * k), 0.002}}});
  ASSERT_TRUE(check_path(path));
  std::vector<Vec3> first;
  probe_path(*law, path, [&](const PathSample&, const LawOutput& f) { first.push_back(f.force_N.v); });
  std::size_t at = 0;
  probe_path(*law, path, [&](const PathSample&, const LawOutput& f) { EXPECT_EQ(f.force_N.v, first[at++]); });
  EXPECT_EQ(at, path.size());
  const TickTimes times = time_path(*law, path);
  EXPECT_EQ(times.latency.count, path.size());
  EXPECT_GT(times.latency.p50_ns, 0.0);
  const TickTimes least = time_path(*law, path, 5);
  EXPECT_EQ(least.latency.count, path.size());
  EXPECT_EQ(least.contact_fraction, times.contact_fraction);
  path[7].t_s = path[6].t_s;
  EXPECT_FALSE(check_path(path));
  path[7].t_s = std::nan("");
  EXPECT_FALSE(check_path(path));
}

}  // namespace
}  // namespace palpable::haptics
