// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Fast hands near cliffs, walls and hills of coarse and fine pixels, and near round solids. There must be no
// force in free air, and the first contact must be reported in the tick in which it happens. The ground truth
// is sampled densely from the surface itself.
#include "palpable/haptics/law/stroke_scenes.hpp"
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/models/scene/test_grid.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

struct Stroke {
  Vec3 from;
  Vec3 to;
  double speed_m_per_s;
};

struct Findings {
  int clear_ticks = 0;
  int first_contacts = 0;
  int pushed_in_air = 0;
  int late = 0;
  double greatest_first_N = 0.0;
};

/// `height_over(p)` > 0 outside. A stroke ends with its first contact.
template <class HeightOver>
void follow(const Touchable& touchable, const Stroke& stroke, HeightOver height_over, Findings& findings) {
  constexpr int kBetween = 200;
  // Errors of the sampled ground truth.
  constexpr double kMargin_m = 3e-6;
  const double length = norm(stroke.to - stroke.from);
  const int ticks = std::max(2, static_cast<int>(length / (stroke.speed_m_per_s * kT_s)));
  TouchState state;
  Hand hand;
  Vec3 last = stroke.from;
  for (int n = 0; n <= ticks; ++n) {
    const Vec3 p = stroke.from + (static_cast<double>(n) / ticks) * (stroke.to - stroke.from);
    double least = height_over(p);
    for (int k = 1; n > 0 && k < kBetween; ++k)
      least = std::min(least, height_over(last + (static_cast<double>(k) / kBetween) * (p - last)));
    hand.position = {p};
    hand.velocity_m_per_s = {(n > 0 ? 1.0 : 0.0) / kT_s * (p - last)};
    const LawOutput output = touchable.evaluate(hand, state);
    const double force_N = norm(output.force_N);
    if (n == 0 && least <= kMargin_m) return;
    if (least > kMargin_m) {
      ++findings.clear_ticks;
      findings.pushed_in_air += force_N > 0.0 || output.contact ? 1 : 0;
    } else {
      if (height_over(p) < -kMargin_m) {
        ++findings.first_contacts;
        findings.late += output.contact && force_N > 0.0 ? 0 : 1;
        // Force per length of the path of one tick, since the hand cannot be deeper than that path.
        findings.greatest_first_N = std::max(findings.greatest_first_N, force_N / (norm(p - last) + 1e-6));
      }
      return;
    }
    last = p;
  }
}

Stroke random_stroke(std::mt19937& random, double fastest_m_per_s) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Vec3 from{0.026 * unit(random), 0.016 * unit(random), 0.0105};
  // First down to a random point, then mostly along the surface: grazing movements are the difficult ones.
  const Vec3 to{0.026 * unit(random), 0.016 * unit(random), 0.004 + 0.004 * unit(random)};
  return {from, to, fastest_m_per_s * std::exp(-1.5 * std::abs(unit(random)))};
}

void expect_free_air(const Findings& findings) {
  EXPECT_EQ(findings.pushed_in_air, 0) << "of " << findings.clear_ticks;
  EXPECT_EQ(findings.late, 0) << "of " << findings.first_contacts;
  EXPECT_LE(findings.greatest_first_N, 1.01 * kStrokeStiffness_N_per_m);
  EXPECT_GT(findings.clear_ticks, 20000);
  EXPECT_GT(findings.first_contacts, 500);
}

TEST(FreeAir, HasNoForceAndEndsInTheTickOfTheFirstContactOnReliefsOfEveryResolution) {
  std::mt19937 random(5);
  Findings findings;
  for (const double pixel_m : {0.0001, 0.00025, 0.0007, 0.002})
    for (int ground = 0; ground < 2; ++ground) {
      const models::Scene scene = rough_scene(pixel_m, random);
      const auto& relief = *models::relief_of(scene);
      LawParameters p = frictionless();
      p.stiffness_N_per_m = kStrokeStiffness_N_per_m;
      p.static_friction = ground == 0 ? 0.0 : 0.5;
      const auto law = made(scene, p);
      for (int k = 0; k < 250; ++k)
        follow(
            *law, random_stroke(random, 2.0), [&](Vec3 at) { return at.z - relief.sample(at.x, at.y).z_m; },
            findings);
    }
  expect_free_air(findings);
}

TEST(FreeAir, HasNoForceAndEndsInTheTickOfTheFirstContactRoundSolids) {
  std::mt19937 random(6);
  Findings findings;
  const Pebbles pebbles;
  for (const double friction : {0.0, 0.5}) {
    const SolidTouchable<Pebbles> touchable(friction);
    for (int k = 0; k < 800; ++k) {
      Stroke stroke = random_stroke(random, 2.0);
      stroke.to.z -= 0.002;
      follow(
          touchable, stroke, [&](Vec3 at) { return pebbles.sample({at}).distance_m; }, findings);
    }
  }
  expect_free_air(findings);
}

/// The laws with contact on reliefs that do not state that they break these rules; and `averaged` without
/// neighbours.
std::vector<LawParameters> laws_that_keep_air_free() {
  std::vector<LawParameters> laws;
  for (const LawDescription* law : all_laws())
    if (law->models.relief && law->is_contact && (law->contact_error.empty() || law->law == Law::averaged)) {
      LawParameters p = frictionless();
      p.law = law->law;
      p.stiffness_N_per_m = kStrokeStiffness_N_per_m;
      if (law->law == Law::averaged) p.neighbour_weight = 0.0;
      laws.push_back(p);
    }
  return laws;
}

TEST(FreeAir, HasNoForceUnderAnyLawThatDoesNotStateOtherwise) {
  std::mt19937 random(7);
  Findings findings;
  ASSERT_GE(laws_that_keep_air_free().size(), 3U);
  for (const double pixel_m : {0.00025, 0.0007, 0.002})
    for (const LawParameters& p : laws_that_keep_air_free()) {
      const models::Scene scene = rough_scene(pixel_m, random);
      const auto& relief = *models::relief_of(scene);
      const auto touchable = made(scene, p);
      for (int k = 0; k < 250; ++k)
        follow(
            *touchable, random_stroke(random, 2.0),
            [&](Vec3 at) { return at.z - relief.sample(at.x, at.y).z_m; }, findings);
    }
  EXPECT_EQ(findings.pushed_in_air, 0) << "of " << findings.clear_ticks;
  EXPECT_EQ(findings.late, 0) << "of " << findings.first_contacts;
  EXPECT_GT(findings.first_contacts, 200);
}

TEST(FreeAir, IsKeptByTheDefaultOfEveryKindOfModel) {
  for (const auto kind :
       {&ModelKinds::relief, &ModelKinds::field, &ModelKinds::grid, &ModelKinds::contours}) {
    const auto laws = all_laws();
    const auto first =
        std::find_if(laws.begin(), laws.end(), [&](const auto* law) { return law->models.*kind; });
    ASSERT_NE(first, laws.end());
    EXPECT_TRUE((*first)->contact_error.empty()) << (*first)->name;
  }
}

TEST(FreeAir, IsBrokenByTheAveragedSurfaceAsFarAsItStates) {
  EXPECT_FALSE(description_of(Law::averaged).contact_error.empty());
  constexpr double kHigh_m = 0.008;
  for (const bool is_pit : {true, false}) {
    // A pit or a spike of 1.2 mm, smaller than twice the offset of 1 mm.
    Raster<float> z(200, 200, is_pit ? static_cast<float>(kHigh_m) : 0.0F);
    for (int j = 97; j < 103; ++j)
      for (int i = 97; i < 103; ++i) z(i, j) = static_cast<float>(is_pit ? 0.0 : kHigh_m);
    const models::Scene scene = scene_of(std::move(z));
    LawParameters p = frictionless();
    p.law = Law::averaged;
    const auto law = made(scene, p);
    TouchState state;
    const auto touches = [&](double height_m) {
      return output_at(*law, state, {0.0, 0.0, height_m}).contact;
    };
    EXPECT_TRUE(touches((is_pit ? 0.79 : 0.19) * kHigh_m));
    EXPECT_FALSE(touches((is_pit ? 0.81 : 0.21) * kHigh_m));
  }
}

TEST(FreeAir, HasNoForceAboveTheSurfaceOfAGrid) {
  const auto plate = models::grid_scene({21, 21, 9}, 0.004F, [](int z) { return z <= 5; });
  LawParameters p;
  p.law = Law::grid;
  const auto law = made(plate, p);
  std::mt19937 random(8);
  Findings findings;
  for (int k = 0; k < 500; ++k) {
    Stroke stroke = random_stroke(random, 2.0);
    stroke.from = {0.3 * stroke.from.x, 0.3 * stroke.from.y, 0.0105};
    stroke.to = {0.3 * stroke.to.x, 0.3 * stroke.to.y, 0.5 * stroke.to.z};
    // Its surface is half a spacing above the last occupied points, to a hundredth of the spacing.
    follow(
        *law, stroke, [](Vec3 at) { return at.z - 0.00451; }, findings);
  }
  EXPECT_EQ(findings.pushed_in_air, 0) << "of " << findings.clear_ticks;
  EXPECT_GT(findings.clear_ticks, 1000);
}

TEST(FreeAir, ComesAtOnceToAHandThatLeavesASlopeFast) {
  Raster<float> slope(400, 100);
  for (int j = 0; j < slope.height(); ++j)
    for (int i = 0; i < slope.width(); ++i) slope(i, j) = static_cast<float>(0.3 * i * 0.0001);
  const models::Scene scene = scene_of(std::move(slope), 0.0001);
  const auto& relief = *models::relief_of(scene);
  const auto law = made(scene, frictionless());
  TouchState state;
  const auto above = [&](double x, double height) {
    return Vec3{x, 0.0, relief.sample(x, 0.0).z_m + height};
  };
  output_at(*law, state, above(-0.015, 0.001));
  // Along the slope at 2 m/s, 0.1 mm below it: without friction the force is exactly along the normal,
  // without delay.
  const Vec3 normal = unit(Vec3{-0.3, 0.0, 1.0});
  for (double x = -0.015; x < 0.0; x += 0.002) {
    const LawOutput output = output_at(*law, state, above(x, -0.0001));
    ASSERT_TRUE(output.contact);
    EXPECT_NEAR(norm(cross(output.force_N.v, normal)), 0.0, 1e-4) << x;
  }
  const LawOutput left = output_at(*law, state, above(0.002, 0.0001));
  EXPECT_FALSE(left.contact);
  EXPECT_EQ(left.force_N.v, Vec3{});
}

}  // namespace
}  // namespace palpable::haptics
