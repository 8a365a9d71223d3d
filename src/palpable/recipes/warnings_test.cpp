// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What a scene cannot be trusted for is measured by its recipe, and stays with the scene.
#include "palpable/recipes/contours_recipe.hpp"
#include "palpable/recipes/relief/relief_recipe.hpp"
#include "palpable/recipes/solid/grid_recipe.hpp"
#include "palpable/recipes/solid/sheet_recipe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include <gmock/gmock.h>

namespace palpable::recipes {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Each warning is a note too.
void expect_notes_too(const MadeScene& made) {
  for (const std::string& warning : made.scene.warnings)
    EXPECT_TRUE(std::any_of(made.notes.begin(), made.notes.end(), [&](const Note& note) {
      return note.sentence == warning;
    })) << warning;
}

// A wide near board beside narrow slats half as near: a share of the local mean, subtracted, lowers the board
// below the slats.
DepthInput boards() {
  DepthMap map;
  map.depth_m = Raster<float>(160, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      const bool is_slat = x % 12 < 6;
      map.depth_m(x, y) = x < 80 ? 1.0F : is_slat ? 1.5F : 2.0F;
    }
  return {std::move(map), {}};
}

TEST(Warnings, SayThatTheDetailOperatorDoesNotKeepTheOrderOfDepth) {
  ReliefRecipe recipe;
  recipe.relief.detail = sculpt::DetailOperator::linear;
  EXPECT_THAT(relief_from_depth(boards(), recipe, {})->scene.warnings, IsEmpty());
  recipe.relief.detail = sculpt::DetailOperator::chiu;
  const auto made = relief_from_depth(boards(), recipe, {});
  ASSERT_TRUE(made);
  EXPECT_THAT(made->scene.warnings, ElementsAre(HasSubstr("Heights are out of proportion")));
  expect_notes_too(*made);
  recipe.least_kept_order = 0.0;
  EXPECT_THAT(relief_from_depth(boards(), recipe, {})->scene.warnings, IsEmpty());
}

// No operator keeps the order of noise quite.
TEST(Warnings, AdviseTheLinearOperatorOnlyWhereItIsNotUsed) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> noise(0.5F, 1.5F);
  DepthMap map;
  map.depth_m = Raster<float>(160, 120);
  for (float& depth_m : map.depth_m.values()) depth_m = noise(random);
  const DepthInput input{std::move(map), {}};
  ReliefRecipe recipe;
  recipe.least_kept_order = 1.0;
  for (const auto detail : {sculpt::DetailOperator::linear, sculpt::DetailOperator::chiu}) {
    recipe.relief.detail = detail;
    const auto made = relief_from_depth(input, recipe, {});
    ASSERT_TRUE(made);
    ASSERT_THAT(made->scene.warnings, ElementsAre(HasSubstr("Heights are out of proportion")));
    const bool advises = made->scene.warnings[0].find("linear detail operator") != std::string::npos;
    EXPECT_EQ(advises, detail != sculpt::DetailOperator::linear) << made->scene.warnings[0];
  }
}

/// Random dots; the right picture is the left one moved by `shift`, or another one.
vision::StereoPair pair_of(int shift, bool same) {
  constexpr int kWidth = 160, kHeight = 120;
  std::mt19937 random(5);
  Image left{kWidth, kHeight, 1, 8, {}}, right = left;
  Raster<float> dots(kWidth + 32, kHeight), others(kWidth + 32, kHeight);
  for (Raster<float>* picture : {&dots, &others})
    for (float& v : picture->values()) v = static_cast<float>(random() % 256) / 255.0F;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool is_near = x > 60 && x < 110 && y > 30 && y < 90;
      left.samples.push_back(dots(x, y));
      right.samples.push_back((same ? dots : others)(x + (is_near ? shift : shift / 4), y));
    }
  return {left, right, {}};
}

TEST(Warnings, SayOfAPairThatHardlyMatchesWhatItsVerdictSays) {
  StereoRecipe stereo;
  stereo.method = vision::StereoMethod::scanline;
  const auto unlike = relief_from_pair(pair_of(8, false), stereo, {}, {});
  ASSERT_TRUE(unlike);
  ASSERT_FALSE(unlike->scene.warnings.empty());
  EXPECT_THAT(unlike->scene.warnings.front(), HasSubstr("This pair is hardly fit to touch"));
  expect_notes_too(*unlike);
  const auto grid = grid_from_pair(pair_of(8, false), stereo, {}, {}, {});
  ASSERT_TRUE(grid) << grid.error().sentence();
  ASSERT_FALSE(grid->scene.warnings.empty());
  EXPECT_EQ(grid->scene.warnings.front(), unlike->scene.warnings.front());
  const auto alike = relief_from_pair(pair_of(8, true), stereo, {}, {});
  ASSERT_TRUE(alike);
  EXPECT_THAT(alike->scene.warnings, testing::Not(testing::Contains(HasSubstr("This pair"))));
}

Image picture_of(double level, double ink, double noise) {
  constexpr int kWidth = 320, kHeight = 240;
  std::mt19937 random(7);
  std::normal_distribution<double> grain(0.0, 1.0);
  Image image{kWidth, kHeight, 1, 8, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool is_line = std::abs(std::hypot(x - 160.0, y - 120.0) - 70.0) < 2.0;
      const double v = (is_line ? ink : level) + noise * grain(random);
      image.samples.push_back(static_cast<float>(std::round(255.0 * std::clamp(v, 0.0, 1.0)) / 255.0));
    }
  return image;
}

TEST(Warnings, SayThatAPictureIsBlankOrABadPhotograph) {
  EXPECT_THAT(contours_from_picture(picture_of(0.9, 0.1, 0.0), {}, {})->scene.warnings, IsEmpty());
  const auto blank = contours_from_picture(picture_of(0.9, 0.9, 0.0), {}, {});
  ASSERT_TRUE(blank);
  EXPECT_THAT(blank->scene.warnings, ElementsAre(HasSubstr("it has only one tone")));
  expect_notes_too(*blank);
  const auto dark = contours_from_picture(picture_of(0.2, 0.05, 0.03), {}, {});
  ASSERT_TRUE(dark);
  EXPECT_THAT(dark->scene.warnings, ElementsAre(HasSubstr("The picture is dark")));
  EXPECT_THAT(dark->scene.warnings, ElementsAre(HasSubstr("noisy")));
  expect_notes_too(*dark);
}

/// A sheet of 60 x 60 mm whose height is `height(x, y)`.
template <class Height>
Mesh sheet_of(const Height& height) {
  constexpr std::uint32_t kCells = 60;
  Mesh mesh;
  for (std::uint32_t j = 0; j <= kCells; ++j)
    for (std::uint32_t i = 0; i <= kCells; ++i) {
      const double x = 0.001 * i - 0.03, y = 0.001 * j - 0.03;
      mesh.vertices_m.push_back({x, y, height(x, y)});
    }
  for (std::uint32_t j = 0; j < kCells; ++j)
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

TEST(Warnings, SayThatSteepPartsOfASheetBecameRamps) {
  SheetRecipe recipe;
  recipe.placement.up = AxisDirection::plus_z;
  recipe.placement.lay = sculpt::Lay::flat;
  const auto gentle =
      relief_from_mesh(sheet_of([](double x, double) { return 0.005 + 0.1 * x; }), recipe, {});
  ASSERT_TRUE(gentle);
  EXPECT_THAT(gentle->scene.warnings, IsEmpty());
  const auto walls = relief_from_mesh(
      sheet_of([](double x, double y) { return std::hypot(x, y) < 0.015 ? 0.010 : 0.0; }), recipe, {});
  ASSERT_TRUE(walls);
  EXPECT_THAT(walls->scene.warnings, ElementsAre(HasSubstr("too steep for a relief in")));
  expect_notes_too(*walls);
}

}  // namespace
}  // namespace palpable::recipes
