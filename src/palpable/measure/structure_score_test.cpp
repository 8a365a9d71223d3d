// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/structure_score.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::measure {
namespace {

using TrueFromFound = Transform<TrueWorldFrame, WorldFrame>;

// The unit square at a height, of two triangles.
void add_square(Mesh& mesh, double z) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const Vec3 corner : {Vec3{0, 0, z}, Vec3{1, 0, z}, Vec3{1, 1, z}, Vec3{0, 1, z}})
    mesh.vertices_m.push_back(corner);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

Mesh square() {
  Mesh mesh;
  add_square(mesh, 0);
  return mesh;
}

// A lattice of points on the unit square from `least_x` on, alternately above and below it.
PointCloud lattice(double least_x, double height) {
  PointCloud out;
  for (int i = 0; i <= 100; ++i)
    for (int k = 0; k <= 100; ++k)
      if (i / 100.0 >= least_x - 1e-9)
        out.places_m.push_back({i / 100.0, k / 100.0, (i + k) % 2 == 0 ? height : -height});
  return out;
}

StructureScoreOptions whole_box() {
  StructureScoreOptions out;
  out.box_tail = 0.0;
  return out;
}

TEST(StructureScore, MeasuresTheDistanceFromTrianglesInPercentOfTheDiagonal) {
  const double height = 0.01, diagonal = std::sqrt(2 + 4 * height * height);
  const auto score = score_structure(lattice(0, height), {}, square(), {}, whole_box(), {});
  ASSERT_TRUE(score);
  EXPECT_EQ(score->points, 101U * 101U);
  EXPECT_NEAR(score->diagonal, diagonal, 1e-12);
  EXPECT_NEAR(score->accuracy_median_percent, 100 * height / diagonal, 1e-3);
  EXPECT_NEAR(score->accuracy_rms_percent, 100 * height / diagonal, 1e-3);
  EXPECT_NEAR(score->accuracy_truncated_rms_percent, 100 * height / diagonal, 1e-3);
}

TEST(StructureScore, TruncatesFewLargeDistances) {
  PointCloud found = lattice(0, 0.001);
  for (std::size_t i = 0; i < 50; ++i) found.places_m[i].z = 0.5;
  const auto score = score_structure(found, {}, square(), {}, {}, {});
  ASSERT_TRUE(score);
  EXPECT_NEAR(score->accuracy_truncated_rms_percent, 0.1 / score->diagonal, 1e-3);
  EXPECT_GT(score->accuracy_rms_percent, 1.0);
}

TEST(StructureScore, MeasuresCompletenessByArea) {
  // Points on the right 70 % and one point at the left border, so that the region is the whole square.
  // Surface samples within 1 % of the diagonal beside a point count as found.
  PointCloud found = lattice(0.3, 0.0);
  found.places_m.push_back({0, 0, 0});
  const auto score = score_structure(found, {}, square(), {}, whole_box(), {});
  ASSERT_TRUE(score);
  EXPECT_NEAR(score->completeness_percent, 100 * (0.7 + 0.01 * std::sqrt(2)), 0.5);
  EXPECT_FALSE(score->visible_completeness_percent);
}

TEST(StructureScore, LeavesOutWhatNoCameraSees) {
  // Two sheets. Only the upper one was found, and a few points give the region its height.
  Mesh truth = square();
  add_square(truth, 0.2);
  PointCloud found;
  for (const Vec3 p : lattice(0, 0.0).places_m) found.places_m.push_back({p.x, p.y, 0.2});
  found.places_m.push_back({0, 0, 0});
  TrueCamera above, below;
  above.pose.translation_m = {0.5, 0.5, 3}, below.pose.translation_m = {0.5, 0.5, -3};
  const auto from_above = score_structure(found, {}, truth, {&above, 1}, whole_box(), {});
  ASSERT_TRUE(from_above);
  EXPECT_NEAR(from_above->completeness_percent, 50, 0.5);
  EXPECT_GT(*from_above->visible_completeness_percent, 99.9);
  const auto from_below = score_structure(found, {}, truth, {&below, 1}, whole_box(), {});
  ASSERT_TRUE(from_below);
  EXPECT_LT(*from_below->visible_completeness_percent, 1.0);
}

TEST(StructureScore, LeavesOutWhatIsInNoPicture) {
  // The camera, one unit above the square, sees its right 70 %, where the points are.
  PointCloud found = lattice(0.3, 0.0);
  found.places_m.push_back({0, 0, 0});
  TrueCamera camera;
  camera.pose.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  camera.pose.translation_m = {0.5, 0.5, 1};
  camera.pinhole = Pinhole{100, 100, 19.5, 99.5, 200, 200};
  const auto score = score_structure(found, {}, square(), {&camera, 1}, whole_box(), {});
  ASSERT_TRUE(score);
  EXPECT_LT(score->completeness_percent, 73);
  EXPECT_GT(*score->visible_completeness_percent, 99.9);
}

TEST(StructureScore, AlignsBeforeItCompares) {
  TrueFromFound alignment;
  alignment.rotation = {0, 0, 1, 1, 0, 0, 0, 1, 0};
  alignment.scale = 0.25;
  alignment.translation_m = {3, -1, 2};
  PointCloud moved = lattice(0, 0.01);
  for (Vec3& p : moved.places_m) p = (alignment.inverse() * Point<TrueWorldFrame>{p}).v;
  const auto score = score_structure(moved, alignment, square(), {}, whole_box(), {});
  const auto aligned = score_structure(lattice(0, 0.01), {}, square(), {}, whole_box(), {});
  ASSERT_TRUE(score && aligned);
  EXPECT_NEAR(score->accuracy_rms_percent, aligned->accuracy_rms_percent, 1e-6);
  EXPECT_NEAR(score->diagonal, aligned->diagonal, 1e-9);
}

TEST(StructureScore, MeasuresDistancesFromPointsAsBruteForceDoes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 1);
  const auto cloud = [&](int count) {
    PointCloud out;
    for (int i = 0; i < count; ++i) out.places_m.push_back({place(random), place(random), place(random)});
    return out;
  };
  const PointCloud found = cloud(300), truth = cloud(200);
  double sum = 0.0;
  for (const Vec3 p : found.places_m) {
    double least = 10;
    for (const Vec3 q : truth.places_m) least = std::min(least, squared_norm(p - q));
    sum += least;
  }
  const auto score = score_structure(found, {}, truth, {}, whole_box(), {});
  ASSERT_TRUE(score);
  const double rms = std::sqrt(sum / 300);
  EXPECT_NEAR(score->accuracy_rms_percent, 100 * rms / score->diagonal, 1e-3 * 100 * rms / score->diagonal);
}

TEST(StructureScore, ScoresResultsFarFromTheTruth) {
  TrueFromFound away;
  away.translation_m = {0, 0, 100};
  const auto score = score_structure(lattice(0, 0.01), away, square(), {}, {}, {});
  ASSERT_TRUE(score);
  EXPECT_NEAR(score->accuracy_median_percent, 100 * 100 / score->diagonal, 10);
  EXPECT_EQ(score->completeness_percent, 0.0);
}

TEST(StructureScore, RefusesWhatCannotBeCompared) {
  EXPECT_FALSE(score_structure({}, {}, square(), {}, {}, {}));
  EXPECT_FALSE(score_structure(lattice(0, 0.01), {}, Mesh{}, {}, {}, {}));
  EXPECT_FALSE(score_structure(lattice(0, 0.01), {}, PointCloud{}, {}, {}, {}));
  PointCloud one_place;
  one_place.places_m.assign(100, {1, 1, 1});
  EXPECT_FALSE(score_structure(one_place, {}, square(), {}, {}, {}));
  StructureScoreOptions wrong;
  wrong.piece = 0.0;
  const auto refused = score_structure(lattice(0, 0.01), {}, square(), {}, wrong, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::measure
