// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/surface_strokes.hpp"

#include "palpable/device/drivers/open.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

models::Superquadric ellipsoid(Vec3 centre_m, Vec3 half_m) {
  models::Superquadric shape;
  shape.size_m = half_m;
  shape.scene_from_shape.translation_m = centre_m;
  return shape;
}

models::Scene solid(std::vector<models::Superquadric> shapes, recipes::FieldStorage storage) {
  recipes::FieldRecipe recipe;
  recipe.storage = storage;
  recipe.field.resolution = 32;
  auto made = recipes::field_from_superquadrics(std::move(shapes), recipe, {});
  EXPECT_TRUE(made) << made.error().sentence();
  return std::move(made->scene);
}

using Shapes = std::vector<models::Superquadric>;

Shapes ball() { return {ellipsoid({}, {0.04, 0.04, 0.04})}; }

/// Its top is far from the middle of its box, which is mostly empty.
Shapes tower() {
  return {ellipsoid({-0.035, 0.035, 0.03}, {0.006, 0.006, 0.04}),
          ellipsoid({0.0, 0.0, -0.008}, {0.045, 0.045, 0.002})};
}

Shapes animal() {
  return {ellipsoid({0.0, 0.0, 0.0}, {0.03, 0.014, 0.012}),
          ellipsoid({0.03, 0.014, 0.008}, {0.012, 0.01, 0.01}),
          ellipsoid({-0.02, -0.025, 0.0}, {0.005, 0.02, 0.005}),
          ellipsoid({0.02, -0.025, 0.0}, {0.005, 0.02, 0.005})};
}

/// Three seconds' ticks of a simulated hand on a scene, without a clock.
haptics::TickCounts explored(const models::Scene& scene, std::uint64_t seed, bool knows_the_surface) {
  device::OpenOptions options;
  options.seed = seed;
  if (knows_the_surface)
    options.strokes = [&](const device::Traits& traits) {
      return strokes_along_solid(scene, haptics::fit_workspace(scene, traits));
    };
  const auto device = device::open_device("sim:", options);
  EXPECT_TRUE(device);
  const auto& traits = (*device)->traits();
  KeptSurfaces kept;
  const auto prepared = prepare_scene(scene, {}, traits, 1000.0, haptics::fit_workspace(scene, traits), kept);
  EXPECT_TRUE(prepared) << prepared.error().sentence();
  Ring<haptics::TouchEvent> events(4096);
  haptics::TickPipeline tick(**device, prepared->scene, {}, events);
  for (int n = 0; n < 3000; ++n) tick.step(0.001 * n, 0.001);
  return tick.counts();
}

void expect_touched(const std::string& name, const models::Scene& scene) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto counts = explored(scene, seed, true);
    EXPECT_GT(static_cast<double>(counts.contact_ticks), 0.3 * static_cast<double>(counts.ticks))
        << name << ", seed " << seed;
    EXPECT_LT(counts.first_force_t_s, 0.5) << name << ", seed " << seed;
  }
}

TEST(SurfaceStrokes, KeepASimulatedHandOnASolid) {
  using recipes::FieldStorage;
  expect_touched("ball", solid(ball(), FieldStorage::adaptive));
  expect_touched("animal", solid(animal(), FieldStorage::adaptive));
  expect_touched("ball, dense", solid(ball(), FieldStorage::dense));
  expect_touched("ball, with the paper's forces", solid(ball(), FieldStorage::paper));
}

TEST(SurfaceStrokes, AreNeededOnASolidThatLeavesMostOfItsBoxEmpty) {
  const models::Scene scene = solid(tower(), recipes::FieldStorage::adaptive);
  expect_touched("tower", scene);
  std::uint64_t without = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) without += explored(scene, seed, false).contact_ticks;
  EXPECT_LT(without, 4 * 900U);
}

TEST(SurfaceStrokes, GiveTheSameTouchForTheSameSeed) {
  const models::Scene scene = solid(ball(), recipes::FieldStorage::dense);
  const auto first = explored(scene, 5, true), again = explored(scene, 5, true);
  EXPECT_EQ(first.contact_ticks, again.contact_ticks);
  EXPECT_EQ(first.first_force_t_s, again.first_force_t_s);
  EXPECT_EQ(first.max_force_N, again.max_force_N);
}

TEST(SurfaceStrokes, LieOnTheSurfaceSeenFromAbove) {
  const models::Scene scene = solid(ball(), recipes::FieldStorage::adaptive);
  const Transform<SceneFrame, DeviceFrame> same;
  const auto strokes = strokes_along_solid(scene, same);
  ASSERT_FALSE(strokes.empty());
  for (const auto& stroke : strokes) {
    EXPECT_GE(stroke.size(), 2U);
    // The view from above has the width of a cell of the field, so that steep sides are blurred by it.
    for (const auto& point : stroke) EXPECT_NEAR(norm(point.v), 0.04, 0.001);
  }
}

TEST(SurfaceStrokes, AreNotNeededOnARelief) {
  EXPECT_TRUE(strokes_along_solid(hilly_scene(0.01), {}).empty());
}

}  // namespace
}  // namespace palpable::session
