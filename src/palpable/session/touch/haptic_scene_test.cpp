// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/haptic_scene.hpp"

#include "palpable/device/drivers/open.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/models/scene/test_grid.hpp"

#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

constexpr double kRate_hz = 1000.0;

models::Scene wave() {
  Raster<float> samples(64, 48);
  for (int y = 0; y < samples.height(); ++y)
    for (int x = 0; x < samples.width(); ++x)
      samples(x, y) = static_cast<float>(0.005 * (1.0 + std::sin(0.2 * x)));
  models::Scene scene;
  scene.model =
      std::make_shared<const models::Relief>(*models::Relief::from_samples(std::move(samples), 0.001));
  scene.materials = {models::Material{}};
  return scene;
}

class PreparingAScene : public testing::Test {
 protected:
  void SetUp() override {
    auto device = device::open_device("sim:", {});
    ASSERT_TRUE(device);
    traits_ = (*device)->traits();
  }
  PreparedScene prepare(const TouchSettings& settings, KeptSurfaces& kept) const {
    auto prepared =
        prepare_scene(scene_, settings, traits_, kRate_hz, haptics::fit_workspace(scene_, traits_), kept);
    EXPECT_TRUE(prepared);
    return prepared ? std::move(*prepared) : PreparedScene{};
  }
  Vec3 force(const PreparedScene& prepared, Vec3 at_m) const {
    haptics::TouchState state;
    haptics::Hand hand;
    hand.position.v = at_m;
    return prepared.scene.touchable->evaluate(hand, state).force_N.v;
  }

  models::Scene scene_ = wave();
  device::Traits traits_;
};

TEST_F(PreparingAScene, MakesItsSurfaceOnceWhileOnlyParametersChange) {
  KeptSurfaces kept;
  TouchSettings settings;
  settings.law.radius_m = 0.002;
  settings.height_factor = 2.0;
  const auto first = prepare(settings, kept);
  const auto scaled = kept.scaled;
  const auto dilated = kept.dilated.surface;
  ASSERT_TRUE(scaled && dilated);
  settings.law.stiffness_N_per_m = 100.0;
  const auto softer = prepare(settings, kept);
  EXPECT_EQ(kept.scaled, scaled);
  EXPECT_EQ(kept.dilated.surface, dilated);
  EXPECT_EQ(softer.scene.touchable->state_family(), first.scene.touchable->state_family());
}

TEST_F(PreparingAScene, NeverUsesACachedSurfaceOfAnotherScene) {
  KeptSurfaces kept;
  const Vec3 under{0.0073, 0.0041, 0.002};
  for (const double radius_m : {0.001, 0.003})
    for (const double height_factor : {2.0, 1.5, 1.0}) {
      TouchSettings settings;
      settings.law.radius_m = radius_m;
      settings.height_factor = height_factor;
      KeptSurfaces fresh;
      EXPECT_EQ(force(prepare(settings, kept), under), force(prepare(settings, fresh), under))
          << radius_m << " " << height_factor;
    }
  scene_ = wave();
  TouchSettings settings;
  settings.law.radius_m = 0.003;
  settings.height_factor = 1.5;
  static_cast<void>(prepare(settings, kept));
  EXPECT_EQ(kept.of, models::relief_of(scene_));
}

TEST_F(PreparingAScene, UsesTheRollingLawOnPlanarDevicesWithANotice) {
  traits_.degrees_of_freedom = 2;
  KeptSurfaces kept;
  const auto prepared = prepare({}, kept);
  EXPECT_EQ(prepared.law.law, haptics::Law::rolling);
  ASSERT_FALSE(prepared.notices.empty());
  EXPECT_NE(prepared.notices.front().find("rolling"), std::string::npos);
}

TEST_F(PreparingAScene, SaysWhatAPlanarDeviceFeelsOfASolid) {
  traits_.degrees_of_freedom = 2;
  scene_ = models::grid_scene({21, 21, 9}, 0.004F, [](int z) { return z <= 5; });
  KeptSurfaces kept;
  const auto prepared = prepare({}, kept);
  ASSERT_FALSE(prepared.notices.empty());
  EXPECT_NE(prepared.notices.front().find("seen from above"), std::string::npos) << prepared.notices.front();
}

TEST_F(PreparingAScene, LowersAStiffnessThatTheDeviceCannotRenderAndSaysSo) {
  TouchSettings settings;
  settings.law.stiffness_N_per_m = 1e5;
  KeptSurfaces kept;
  const auto prepared = prepare(settings, kept);
  EXPECT_LT(prepared.materials.front().stiffness_N_per_m, 1e5);
  ASSERT_FALSE(prepared.notices.empty());
  EXPECT_NE(prepared.notices.front().find("lowered"), std::string::npos);
}

TEST_F(PreparingAScene, RefusesAnInvalidDepthFactor) {
  TouchSettings settings;
  settings.height_factor = std::nan("");
  KeptSurfaces kept;
  EXPECT_FALSE(
      prepare_scene(scene_, settings, traits_, kRate_hz, haptics::fit_workspace(scene_, traits_), kept));
}

TEST_F(PreparingAScene, LowersNoStiffnessWhereTheLimitsAreOff) {
  TouchSettings settings;
  settings.law.stiffness_N_per_m = 5000.0;
  KeptSurfaces kept;
  EXPECT_LT(prepare(settings, kept).materials.front().stiffness_N_per_m, 5000.0);
  settings.limits = Limits::off;
  const PreparedScene unlimited = prepare(settings, kept);
  EXPECT_EQ(unlimited.law.stiffness_N_per_m, 5000.0);
  EXPECT_TRUE(unlimited.notices.empty());
}

TEST_F(PreparingAScene, FitsTheForceOfTheRollingBallToDeviceAndSurface) {
  KeptSurfaces kept;
  TouchSettings settings;
  settings.law.law = haptics::Law::rolling;
  settings.law.slope_force_N = 0.1;
  const auto gentle = prepare(settings, kept);
  EXPECT_TRUE(gentle.notices.empty()) << gentle.notices.front();
  EXPECT_EQ(gentle.law.slope_force_N, 0.1);
  EXPECT_EQ(gentle.law.rolling_smoothing_m, 0.0);
  settings.law.slope_force_N = 50.0;
  const auto limited = prepare(settings, kept);
  EXPECT_LE(*limited.law.slope_force_N, traits_.max_force_N);
  ASSERT_FALSE(limited.notices.empty());
  EXPECT_NE(limited.notices.front().find("greatest that the device gives"), std::string::npos);
  settings.limits = Limits::off;
  EXPECT_EQ(prepare(settings, kept).law.slope_force_N, 50.0);
}

TEST_F(PreparingAScene, SaysThatARollingBallIsDampedMoreThanWasAskedFor) {
  KeptSurfaces kept;
  TouchSettings settings;
  settings.law.law = haptics::Law::rolling;
  settings.law.slope_force_N = 0.1;
  settings.law.damping_Ns_per_m = 0.0;
  const auto damped = prepare(settings, kept);
  EXPECT_GT(*damped.law.damping_Ns_per_m, 0.0);
  ASSERT_EQ(damped.notices.size(), 1U);
  EXPECT_NE(damped.notices.front().find("damping 0 N·s/m was raised"), std::string::npos)
      << damped.notices.front();
  settings.law.damping_Ns_per_m = damped.law.damping_Ns_per_m;
  EXPECT_TRUE(prepare(settings, kept).notices.empty());
  settings.limits = Limits::off;
  settings.law.damping_Ns_per_m = 0.0;
  EXPECT_EQ(prepare(settings, kept).law.damping_Ns_per_m, 0.0);
}

TEST_F(PreparingAScene, SmoothsWhatABallRollsOnWhereItsBendsAreTooSharpAndSaysSo) {
  KeptSurfaces kept;
  TouchSettings settings;
  settings.law.law = haptics::Law::rolling;
  models::Scene spiky = scene_;
  Raster<float> heights = models::relief_of(scene_)->samples_m();
  for (int y = 2; y < heights.height(); y += 7)
    for (int x = 3; x < heights.width(); x += 7) heights(x, y) += 0.0005F;
  spiky.model = std::make_shared<const models::Relief>(
      *models::Relief::from_samples(std::move(heights), models::relief_of(scene_)->pixel_m()));
  const auto prepared =
      prepare_scene(spiky, settings, traits_, kRate_hz, haptics::fit_workspace(spiky, traits_), kept);
  ASSERT_TRUE(prepared) << prepared.error().sentence();
  EXPECT_GT(prepared->law.rolling_smoothing_m, 0.0);
  ASSERT_FALSE(prepared->notices.empty());
  EXPECT_NE(prepared->notices.front().find("smoothed by"), std::string::npos);
}

TEST_F(PreparingAScene, AllowsStifferWallsInAHandThatDampsMore) {
  KeptSurfaces kept;
  TouchSettings settings;
  settings.law.stiffness_N_per_m = 1e5;
  const double loose = prepare(settings, kept).materials.front().stiffness_N_per_m;
  settings.hand_damping_Ns_per_m = 2.0 * haptics::kLeastHandDamping_Ns_per_m;
  EXPECT_GT(prepare(settings, kept).materials.front().stiffness_N_per_m, 1.5 * loose);
}

TEST_F(PreparingAScene, HasATransientWhereItIsAskedForAndTheDeviceCan) {
  KeptSurfaces kept;
  TouchSettings settings;
  EXPECT_EQ(prepare(settings, kept).scene.transient.frequency_hz, 0.0);
  settings.transient = haptics::TransientKind::wood;
  const auto wood = prepare(settings, kept);
  EXPECT_EQ(wood.scene.transient.frequency_hz, haptics::transient_of(settings.transient).frequency_hz);
  EXPECT_TRUE(wood.notices.empty());
  // At 300 Hz there are fewer than five ticks per period.
  settings.transient = haptics::TransientKind::metal;
  const auto metal = prepare(settings, kept);
  EXPECT_EQ(metal.scene.transient.frequency_hz, 0.0);
  EXPECT_EQ(metal.transient, haptics::TransientKind::none);
  ASSERT_EQ(metal.notices.size(), 1U);
  EXPECT_NE(metal.notices.front().find("metal (300 Hz)"), std::string::npos);
}

}  // namespace
}  // namespace palpable::session
