// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/haptics/tick/test_pressing_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/recipes/video/model_growth.hpp"
#include "palpable/session/touch/haptic_scene.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

// A model of a video that grows under a resting hand.
namespace palpable::session {
namespace {

constexpr double kTick_s = 0.001;

// A rounded block of this height on the ground, as triangles.
Mesh block(double height_m, double roundness) {
  models::Superquadric shape;
  shape.size_m = {0.04, 0.03, height_m / 2};
  shape.e1 = shape.e2 = roundness;
  shape.scene_from_shape.translation_m = {0.0, 0.0, height_m / 2};
  return models::mesh_of(shape, 0.002);
}

// The states of a model whose shape changes by millimetres while it is corrected.
std::vector<std::shared_ptr<const models::Scene>> growing_model() {
  std::vector<std::shared_ptr<const models::Scene>> out;
  recipes::FieldRecipe field;
  field.placement.default_size = sculpt::DefaultSize::own;
  const auto take = [&](recipes::MadeScene made) {
    out.push_back(std::make_shared<const models::Scene>(std::move(made.scene)));
  };
  const auto observe = recipes::growing_fields({0.1, 48}, field, {0, 10, 20, 30}, take, {});
  using Kind = recipes::ModelStep::Kind;
  observe({Kind::superquadrics, 0, 0.0020, true}, block(0.0200, 0.9));
  observe({Kind::superquadrics, 1, 0.0015, true}, block(0.0215, 0.6));
  observe({Kind::correction, 2, 0.0008, true}, block(0.0208, 0.4));
  observe({Kind::correction, 3, 0.0004, true}, block(0.0230, 0.4));
  return out;
}

struct Rested {
  // Of one tick, as shares of the force of the resting hand.
  double greatest_step = 0.0, least_force = 1.0, greatest_force = 0.0;
  int changes = 0, ticks_without_contact = 0;
};

class GrowingModel : public testing::Test {
 protected:
  // A hand comes down on the first state, rests, and stays while each later state takes the place of the
  // last.
  Rested rest_on(const std::vector<std::shared_ptr<const models::Scene>>& states,
                 const haptics::TickOptions& options) {
    haptics::PressingHand hand({0.004, 0.003, 0.03});
    std::vector<haptics::HapticScene> scenes;
    for (const auto& state : states) {
      auto prepared = prepare_scene(*state, {}, hand.traits(), 1 / kTick_s,
                                    haptics::fit_workspace(*state, hand.traits()), kept_);
      EXPECT_TRUE(prepared) << prepared.error().sentence();
      if (!prepared) return {};
      scenes.push_back(prepared->scene);
    }
    Ring<haptics::TouchEvent> events(256);
    haptics::TickPipeline tick(hand, scenes.front(), options, events);
    double time_s = 0.0;
    const auto step = [&] { return tick.step(time_s += kTick_s, kTick_s); };
    for (int i = 0; i < 3000; ++i) (void)step();
    Vec3 before = step().written_force_N.v;
    const double resting_N = norm(before);
    EXPECT_GT(resting_N, 0.4);
    Rested out;
    for (std::size_t next = 1; next < scenes.size(); ++next) {
      tick.change(scenes[next]);
      for (int i = 0; i < 600; ++i) {
        const auto sample = step();
        const Vec3 force = sample.written_force_N.v;
        out.greatest_step = std::max(out.greatest_step, norm(force - before) / resting_N);
        out.least_force = std::min(out.least_force, norm(force) / resting_N);
        out.greatest_force = std::max(out.greatest_force, norm(force) / resting_N);
        out.ticks_without_contact += (sample.flags & haptics::flag::kContact) == 0 ? 1 : 0;
        before = force;
      }
      EXPECT_FALSE(tick.fading());
      out.changes += tick.take_retired() == &scenes[next - 1] ? 1 : 0;
    }
    return out;
  }

  KeptSurfaces kept_;
};

TEST_F(GrowingModel, NeverMovesTheForceOnARestingHandBySevenPercentInATick) {
  const auto states = growing_model();
  ASSERT_EQ(states.size(), 4U);
  const Rested rested = rest_on(states, {});
  EXPECT_EQ(rested.changes, 3);
  EXPECT_LE(rested.greatest_step, 0.07);
  // The hand is lifted and let down by the surface under it, and stays on it.
  EXPECT_EQ(rested.ticks_without_contact, 0);
  EXPECT_GT(rested.greatest_force, 1.02);
  EXPECT_GT(rested.least_force, 0.2);
  // Without the cross-fade the same changes are felt as a step.
  haptics::TickOptions at_once;
  at_once.fade_s = kTick_s;
  EXPECT_GT(rest_on(states, at_once).greatest_step, 0.07);
  RecordProperty("greatest_step_percent", std::to_string(100 * rested.greatest_step));
}

}  // namespace
}  // namespace palpable::session
