// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/thin_walls.hpp"

#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kFinest_m = 0.0002;
constexpr WallOptions kWalls{2.0};

/// A ground plate of 100 x 100 x 5 mm with a wall on it, 40 mm wide and 30 mm high, parallel to x.
Mesh plate_with_wall(double thickness_m) {
  return together(box_mesh({-0.05, -0.05, 0.0}, {0.05, 0.05, 0.005}),
                  box_mesh({-0.02, -0.5 * thickness_m, 0.002}, {0.02, 0.5 * thickness_m, 0.03}));
}

/// The same with a sheet of two faces as the wall.
Mesh plate_with_sheet() {
  Mesh sheet;
  sheet.vertices_m = {{-0.02, 0.0, 0.004}, {0.02, 0.0, 0.004}, {0.02, 0.0, 0.03}, {-0.02, 0.0, 0.03}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}};
  return together(box_mesh({-0.05, -0.05, 0.0}, {0.05, 0.05, 0.005}), sheet);
}

double distance_at(const MeshSolid& solid, Vec3 p) {
  DistanceSource::Hint hint;
  return solid.distance->at(p, hint).distance_m;
}

TEST(ThinWalls, ThatAreThinnerThanTwoCellsBecomeThatThick) {
  for (const double thickness_m : {0.00001, 0.0001, 0.0002, 0.0003}) {
    const auto solid = solid_from_mesh(plate_with_wall(thickness_m), kFinest_m, {}, {}, kWalls);
    ASSERT_TRUE(solid);
    EXPECT_GT(solid->repair.thin, 0U);
    const double half_m = -distance_at(*solid, {0.0, 0.0, 0.02});
    EXPECT_GE(half_m, kFinest_m - 1e-9) << thickness_m;
    EXPECT_LE(half_m, 1.25 * kFinest_m + 1e-9) << thickness_m;
    EXPECT_NEAR(distance_at(*solid, {0.0, 0.002, 0.02}), 0.002 - half_m, 1e-6) << thickness_m;
    EXPECT_LE(solid->repair.thickened_m, kFinest_m + 1e-9);
  }
}

TEST(ThinWalls, ThatAreThickEnoughStayAsTheyAre) {
  const auto solid = solid_from_mesh(plate_with_wall(0.00045), kFinest_m, {}, {}, kWalls);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.thin, 0U);
  EXPECT_NEAR(distance_at(*solid, {0.0, 0.0, 0.02}), -0.000225, 1e-7);
}

TEST(ThinWalls, OfSheetsWithoutThicknessBecomeWalls) {
  const auto without = solid_from_mesh(plate_with_sheet(), kFinest_m, {});
  ASSERT_TRUE(without);
  EXPECT_GT(distance_at(*without, {0.0, 0.0, 0.02}), 0.01);
  const auto solid = solid_from_mesh(plate_with_sheet(), kFinest_m, {}, {}, kWalls);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.sheets, 2U);
  EXPECT_NEAR(distance_at(*solid, {0.0, 0.0, 0.02}), -kFinest_m, 1e-7);
  EXPECT_NEAR(distance_at(*solid, {0.0, 0.003, 0.02}), 0.003 - kFinest_m, 1e-6);
  // Nothing else moves.
  EXPECT_NEAR(distance_at(*solid, {0.04, 0.04, 0.006}), 0.001, 1e-7);
  EXPECT_NEAR(distance_at(*solid, {0.04, 0.04, 0.0025}), -0.0025, 1e-7);
  ASSERT_FALSE(solid->repair.notes().empty());
  EXPECT_NE(solid->repair.notes().back().find("One open sheet"), std::string::npos);
}

TEST(ThinWalls, OfASheetThatIsPartlyInTheSolidAreWhereItIsNot) {
  // A sheet of 40 mm across a block of 20 mm.
  Mesh sheet;
  sheet.vertices_m = {{-0.02, 0.001, 0.002}, {0.02, 0.001, 0.002}, {0.0, 0.001, 0.04}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  const auto solid = solid_from_mesh(together(box_mesh({-0.01, -0.01, 0.0}, {0.01, 0.01, 0.02}), sheet),
                                     kFinest_m, {}, {}, kWalls);
  ASSERT_TRUE(solid);
  for (const Vec3 on_sheet : {Vec3{-0.015, 0.001, 0.005}, Vec3{0.0, 0.001, 0.03}, Vec3{0.0, 0.001, 0.023}})
    EXPECT_NEAR(distance_at(*solid, on_sheet), -kFinest_m, 1e-5);
  EXPECT_NEAR(distance_at(*solid, {0.0, 0.006, 0.01}), -0.004, 1e-6);
}

/// Triangles on both sides of a level square.
Mesh level_square(double half_m, double z_m) {
  Mesh square;
  square.vertices_m = {
      {-half_m, -half_m, z_m}, {half_m, -half_m, z_m}, {half_m, half_m, z_m}, {-half_m, half_m, z_m}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}};
  return square;
}

TEST(ThinWalls, AreNotTheGroundThatReachesBeyondTheSolid) {
  const Mesh house = box_mesh({-0.02, -0.03, 0.0}, {0.02, 0.03, 0.02});
  const auto solid = solid_from_mesh(together(house, level_square(0.05, -0.001)), kFinest_m, {}, {}, kWalls);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.ground, 2U);
  EXPECT_EQ(solid->repair.sheets, 0U);
  EXPECT_EQ(solid->distance->bounds().size_m(), (Vec3{0.04, 0.06, 0.02}));
  EXPECT_GT(distance_at(*solid, {0.04, 0.04, -0.001}), 0.02);
  // A shelf under a part of it is a wall.
  const auto shelf = solid_from_mesh(together(house, level_square(0.025, -0.001)), kFinest_m, {}, {}, kWalls);
  ASSERT_TRUE(shelf);
  EXPECT_EQ(shelf->repair.ground, 0U);
  EXPECT_EQ(shelf->repair.sheets, 2U);
}

TEST(ThinWalls, AreWallsBesideAndAboveTheSolidHoweverLarge) {
  const Mesh house = box_mesh({-0.02, -0.03, 0.0}, {0.02, 0.03, 0.02});
  // A ceiling, and a level through the middle.
  for (const double z_m : {0.025, 0.01}) {
    const auto solid = solid_from_mesh(together(house, level_square(0.05, z_m)), kFinest_m, {}, {}, kWalls);
    ASSERT_TRUE(solid);
    EXPECT_EQ(solid->repair.ground, 0U) << z_m;
    EXPECT_NEAR(distance_at(*solid, {0.04, 0.04, z_m}), -kFinest_m, 1e-5) << z_m;
  }
  // A wall behind it: what is up where the x axis is.
  WallOptions turned = kWalls;
  turned.up = {1, 0, 0};
  const auto wall = solid_from_mesh(together(house, level_square(0.05, -0.001)), kFinest_m, {}, {}, turned);
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->repair.ground, 0U);
  EXPECT_EQ(wall->repair.sheets, 2U);
}

TEST(ThinWalls, KeepTheDepthUnderAThickWallBesideThem) {
  const auto solid = solid_from_mesh(plate_with_wall(0.0001), kFinest_m, {}, {}, kWalls);
  ASSERT_TRUE(solid);
  // Beside the wall, the top of the plate is nearest; below the wall, only the thickened sides are farther
  // away.
  EXPECT_NEAR(distance_at(*solid, {0.0, 0.002, 0.004}), -0.001, 1e-7);
  EXPECT_NEAR(distance_at(*solid, {0.03, 0.002, 0.0045}), -0.0005, 1e-7);
}

TEST(ThinWalls, TakeFewMoreCellsOfAFieldThanThickOnes) {
  const auto thin = solid_from_mesh(plate_with_wall(0.0001), 0.1 / 256, {}, {}, kWalls);
  const auto thick = solid_from_mesh(plate_with_wall(2.0 * 0.1 / 256), 0.1 / 256, {});
  ASSERT_TRUE(thin && thick);
  const FieldOptions options{.resolution = 256};
  const auto of_thin = field_from_source(*thin->distance, options, {});
  const auto of_thick = field_from_source(*thick->distance, options, {});
  ASSERT_TRUE(of_thin && of_thick);
  // Its edges are round.
  EXPECT_LT(static_cast<double>(of_thin->leaves()), 1.75 * static_cast<double>(of_thick->leaves()));
}

TEST(ThinWalls, LeaveNoStepInTheDistance) {
  const auto solid = solid_from_mesh(plate_with_wall(0.0001), kFinest_m, {}, {}, kWalls);
  ASSERT_TRUE(solid);
  constexpr double kStep_m = 2e-6;
  // Through the wall and the plate, across their junction.
  double before_m = distance_at(*solid, {0.001, -0.003, 0.009});
  for (Vec3 p{0.001, -0.003, 0.009}; p.y < 0.003; p += Vec3{0.0, kStep_m, -1.2 * kStep_m}) {
    const double now_m = distance_at(*solid, p);
    ASSERT_LE(std::abs(now_m - before_m), 4.0 * kStep_m) << p.y;
    before_m = now_m;
  }
}

TEST(ThinWalls, AreWhereTheyAreInTheField) {
  const auto solid = solid_from_mesh(plate_with_wall(0.0001), 0.1 / 512, {}, {}, kWalls);
  ASSERT_TRUE(solid);
  const auto field = field_from_source(*solid->distance, {}, {});
  ASSERT_TRUE(field);
  const double half_m = -distance_at(*solid, {0.0, 0.0, 0.02});
  for (const double x : {-0.015, -0.0033, 0.004, 0.0161}) {
    EXPECT_NEAR(field->sample({{x, half_m, 0.02}}).distance_m, 0.0, 5e-6) << x;
    EXPECT_LT(field->sample({{x, 0.0, 0.02}}).distance_m, -0.00012) << x;
  }
}

TEST(ThinWalls, AreNotFoundInAWedge) {
  // 30 degrees at its edge.
  Mesh wedge;
  wedge.vertices_m = {{0.0, 0.0, 0.0},   {0.0, 0.05, 0.0},     {0.05, 0.0, 0.0},
                      {0.05, 0.05, 0.0}, {0.05, 0.0, 0.02887}, {0.05, 0.05, 0.02887}};
  wedge.triangles = {{0, 1, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1}, {2, 3, 5}, {2, 5, 4}, {0, 2, 4}, {1, 5, 3}};
  const auto solid = solid_from_mesh(wedge, kFinest_m, {}, {}, kWalls);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.thin + solid->repair.sheets, 0U);
}

}  // namespace
}  // namespace palpable::sculpt
