// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/placement.hpp"

#include "palpable/sculpt/solid/test_solids.hpp"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

using InputPoint = Point<models::InputFrame>;

/// Placement as for solids from files.
PlacementOptions with_up(AxisDirection up) {
  PlacementOptions options;
  options.default_size = DefaultSize::for_a_hand;
  options.convention.up = up;
  return options;
}

/// 8 m wide, 6 m high and 10 m long where y is up.
constexpr Box kHouse{{-4.0, 0.0, -5.0}, {4.0, 6.0, 5.0}};

Vec3 placed(const Placement& placement, Vec3 p) { return (placement.scene_from_input * InputPoint{p}).v; }

void expect_near(Vec3 a, Vec3 b) { EXPECT_LT(norm(a - b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z; }

TEST(Placement, KeepsASolidThatAHandCanFeel) {
  const auto placement =
      placement_of({{-0.03, 0.0, 0.0}, {0.03, 0.06, 0.06}}, with_up(AxisDirection::plus_z));
  ASSERT_TRUE(placement);
  EXPECT_FALSE(placement->fitted);
  expect_near(placed(*placement, {0.01, 0.02, 0.03}), {0.01, 0.02, 0.03});
}

TEST(Placement, MovesASolidOfAHandsSizeFromBesideItsOriginToTheMiddle) {
  const auto placement = placement_of({{0.3, 0.3, 0.3}, {0.38, 0.36, 0.34}}, with_up(AxisDirection::plus_y));
  ASSERT_TRUE(placement);
  EXPECT_TRUE(placement->moved);
  expect_near(placed(*placement, {0.3, 0.3, 0.3}), {-0.04, -0.03, 0.0});
  expect_near(placed(*placement, {0.38, 0.36, 0.34}), {0.04, 0.03, 0.04});
}

TEST(Placement, KeepsAnySolidWhereItsOwnSizeIsAskedFor) {
  const auto placement = placement_of(kHouse, {});
  ASSERT_TRUE(placement);
  EXPECT_FALSE(placement->fitted);
  expect_near(placed(*placement, {1.0, 2.0, 3.0}), {1.0, 2.0, 3.0});
}

TEST(Placement, FitsWhatIsTooLargeOrTooSmallIntoTheWorkingVolume) {
  for (const double scale : {1.0, 1e-6}) {
    const auto placement =
        placement_of({scale * kHouse.least_m, scale * kHouse.most_m}, with_up(AxisDirection::plus_y));
    ASSERT_TRUE(placement);
    EXPECT_TRUE(placement->fitted);
    EXPECT_EQ(placement->lay, Lay::upright);
    // Its depth of 10 fills the 50 mm.
    expect_near(placed(*placement, scale * Vec3{4.0, 6.0, 5.0}), {0.02, 0.015, 0.05});
    expect_near(placed(*placement, scale * Vec3{-4.0, 0.0, -5.0}), {-0.02, -0.015, 0.0});
  }
}

TEST(Placement, PlacesSolidsWithZUpUprightWithTheirFrontToTheUser) {
  // Front at -y, up +z.
  const auto placement = placement_of({{-4.0, -5.0, 0.0}, {4.0, 5.0, 6.0}}, with_up(AxisDirection::plus_z));
  ASSERT_TRUE(placement);
  EXPECT_EQ(placement->lay, Lay::upright);
  expect_near(placed(*placement, {4.0, -5.0, 6.0}), {0.02, 0.015, 0.05});
}

TEST(Placement, LaysAMapFlatWithNorthUpwards) {
  for (const auto& [up, south_east_top] : {std::pair(AxisDirection::plus_y, Vec3{50.0, 4.0, 50.0}),
                                           std::pair(AxisDirection::plus_z, Vec3{50.0, -50.0, 4.0})}) {
    const Vec3 top = unit_vector(up), p = south_east_top;
    const Vec3 half = p - 4.0 * top;
    const Vec3 size{std::abs(half.x), std::abs(half.y), std::abs(half.z)};
    const auto placement = placement_of({-size, size + 4.0 * top}, with_up(up));
    ASSERT_TRUE(placement);
    EXPECT_EQ(placement->lay, Lay::flat);
    expect_near(placed(*placement, p), {0.05, -0.05, 0.004});
  }
}

/// A plate of 100 x 80 x 4 mm with three towers on it, y up: the city of a toy.
Mesh small_city() {
  Mesh city = box_mesh({-0.05, -0.002, -0.04}, {0.05, 0.002, 0.04});
  city = together(std::move(city), box_mesh({-0.035, 0.002, -0.025}, {-0.025, 0.032, -0.015}));
  city = together(std::move(city), box_mesh({0.01, 0.002, 0.01}, {0.03, 0.014, 0.03}));
  return together(std::move(city), box_mesh({0.026, 0.002, -0.029}, {0.034, 0.022, -0.021}));
}

TEST(Placement, LaysACityOfAHandsSizeFlatAndKeepsItsMetres) {
  const Mesh city = small_city();
  const double level = level_share(city, AxisDirection::plus_y);
  EXPECT_NEAR(level, 0.79, 0.02);
  const auto placement = placement_of(bounds_of(city), with_up(AxisDirection::plus_y), level);
  ASSERT_TRUE(placement);
  EXPECT_EQ(placement->lay, Lay::flat);
  EXPECT_TRUE(placement->moved);
  EXPECT_NEAR(placement->scene_from_input.scale, 1.0, 1e-12);
  // The top of the tallest tower, and the plate's near left corner below it.
  expect_near(placed(*placement, {-0.03, 0.032, -0.02}), {-0.03, 0.02, 0.034});
  expect_near(placed(*placement, {-0.05, -0.002, 0.04}), {-0.05, -0.04, 0.0});
  // Asked for, it stands upright.
  PlacementOptions upright = with_up(AxisDirection::plus_y);
  upright.lay = Lay::upright;
  EXPECT_EQ(placement_of(bounds_of(city), upright, level)->lay, Lay::upright);
}

TEST(Placement, KeepsALowSolidThatIsNotLevelUpright) {
  // As low as the city, but a third of a cube's surface is level.
  const Box box{{-0.05, -0.018, -0.04}, {0.05, 0.018, 0.04}};
  EXPECT_EQ(placement_of(box, with_up(AxisDirection::plus_y), 0.33)->lay, Lay::upright);
  EXPECT_NEAR(level_share(box_mesh({0, 0, 0}, {1, 1, 1}), AxisDirection::plus_z), 1.0 / 3.0, 1e-12);
  // A table of 100 x 100 x 70 mm is level, and high.
  EXPECT_EQ(placement_of({{-0.05, 0.0, -0.05}, {0.05, 0.07, 0.05}}, with_up(AxisDirection::plus_y), 0.9)->lay,
            Lay::upright);
}

TEST(Placement, ObeysItsOptions) {
  PlacementOptions options;
  options.up = AxisDirection::minus_x;
  options.lay = Lay::flat;
  options.size_m = Vec3{0.1, 0.1, 0.1};
  const auto placement = placement_of(kHouse, options);
  ASSERT_TRUE(placement);
  EXPECT_EQ(placement->up, AxisDirection::minus_x);
  EXPECT_NEAR(placed(*placement, {-4.0, 0.0, 0.0}).z, 0.08, 1e-12);
  EXPECT_NEAR(placed(*placement, {4.0, 0.0, 0.0}).z, 0.0, 1e-12);
}

TEST(Placement, OnlyTurnsWithoutAMirror) {
  for (const AxisDirection up : kAxisDirections)
    for (const AxisDirection towards : kAxisDirections) {
      const auto r = turn_towards_person(towards, up);
      const Vec3 x{r[0], r[1], r[2]}, y{r[3], r[4], r[5]}, z{r[6], r[7], r[8]};
      EXPECT_NEAR(dot(cross(x, y), z), 1.0, 1e-12);
      expect_near(z, unit_vector(towards));
    }
}

TEST(Placement, RefusesASizeOutOfRangeAndABoxWithoutExtent) {
  PlacementOptions options;
  options.size_m = Vec3{0.1, 0.1, 2.0};
  EXPECT_EQ(placement_of(kHouse, options).error().code, ErrorCode::usage);
  EXPECT_EQ(placement_of({{1, 1, 1}, {1, 1, 1}}, {}).error().code, ErrorCode::invalid_input);
}

TEST(Placement, RefusesASolidWhoseScaleWouldOverflow) {
  for (const double size_m : {1e-30, 1e-13, 1e16, 1e200}) {
    const auto placed = placement_of({{0, 0, 0}, {size_m, size_m, size_m}}, {});
    ASSERT_FALSE(placed) << size_m;
    EXPECT_NE(placed.error().message.find("another unit"), std::string::npos);
  }
  for (const double size_m : {1e-12, 1e14})
    EXPECT_TRUE(placement_of({{0, 0, 0}, {size_m, size_m, size_m}}, {})) << size_m;
}

}  // namespace
}  // namespace palpable::sculpt
