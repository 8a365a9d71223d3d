// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/as_published.hpp"

#include <string>

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

const Published& paper(const std::string& name) {
  static std::optional<Published> found;
  found = *published_as(name);
  return *found;
}

MakeArguments made_as(const std::string& name) {
  MakeArguments arguments;
  apply_published(paper(name), arguments);
  return arguments;
}

haptics::LawParameters felt_as(const std::string& name) {
  haptics::LawParameters law;
  law.law = paper(name).law.law;
  apply_published(paper(name), law);
  return law;
}

bool notes(const std::string& name, std::string_view words) {
  return paper(name).differs.find(words) != std::string_view::npos;
}

TEST(AsPublished, ShiConvolvesTheDisparityOfTheScanlineMethod) {
  const MakeArguments made = made_as("shi");
  EXPECT_EQ(made.stereo.method, "scanline");
  EXPECT_EQ(made.height_of, "disparity");
  EXPECT_EQ(made.detail, "linear");
  EXPECT_EQ(made.texture, "front");
  EXPECT_EQ(made.size, "150x100x15");
  EXPECT_EQ(made.steepest_slope, 100.0);
  EXPECT_EQ(felt_as("shi").law, haptics::Law::sobel);
  EXPECT_EQ(paper("shi").rate_hz, 500.0);
  EXPECT_TRUE(notes("shi", "does not state the height"));
  EXPECT_TRUE(notes("shi", "Of a pair of pictures"));
  EXPECT_TRUE(notes("shi", "their heights are used"));
}

TEST(AsPublished, ParkProjectsTheSceneWithoutGroundAndBackground) {
  const MakeArguments made = made_as("park");
  EXPECT_EQ(made.stereo.method, "graph-cut");
  EXPECT_EQ(made.ground, "remove");
  EXPECT_EQ(made.background, "remove");
  EXPECT_EQ(made.grid_filling, "camera");
  EXPECT_EQ(paper("park").as, session::MakeAs::grid);
  EXPECT_EQ(felt_as("park").law, haptics::Law::grid);
  EXPECT_TRUE(notes("park", "is a product"));
}

TEST(AsPublished, GomezUsesTheChosenOperatorAndAPoint) {
  const MakeArguments made = made_as("gomez");
  EXPECT_EQ(made.stereo.method, "pyramid");
  EXPECT_EQ(made.detail, "bilateral");
  EXPECT_EQ(made.resample, "bicubic");
  EXPECT_EQ(felt_as("gomez").law, haptics::Law::averaged);
  EXPECT_EQ(felt_as("gomez").radius_m, 0.0);
  EXPECT_EQ(paper("gomez").rate_hz, 997.0);
  EXPECT_TRUE(notes("gomez", "weights of the average are corrected"));
}

TEST(AsPublished, GhdMakesContoursOnlySoThatAPairIsRefused) {
  EXPECT_EQ(made_for(paper("ghd")), session::MakeAs::contours);
  EXPECT_EQ(made_for(paper("shi")), session::MakeAs::relief);
  EXPECT_EQ(made_for(paper("park")), session::MakeAs::grid);
  EXPECT_EQ(made_for(paper("moustakas")), session::MakeAs::field);
}

TEST(AsPublished, GhdIsEquation8WithoutBounds) {
  EXPECT_EQ(made_as("ghd").contour_method, "paper");
  EXPECT_EQ(felt_as("ghd").law, haptics::Law::tracing);
  EXPECT_EQ(felt_as("ghd").tracing_bounds, 0.0);
  EXPECT_EQ(felt_as("ghd").damping_Ns_per_m, 0.0);
  EXPECT_EQ(paper("ghd").rate_hz, 400.0);
  EXPECT_TRUE(notes("ghd", "pushes a resting hand"));
}

TEST(AsPublished, MoustakasShadesTheForceOfAStoredLattice) {
  const MakeArguments made = made_as("moustakas");
  EXPECT_TRUE(made.paper);
  EXPECT_EQ(made.surface, "corrected");
  EXPECT_EQ(made.resolution, 400);
  EXPECT_EQ(felt_as("moustakas").law, haptics::Law::penalty);
  EXPECT_EQ(felt_as("moustakas").force_shading, 1.0);
  EXPECT_EQ(felt_as("moustakas").radius_m, 0.0);
  EXPECT_TRUE(notes("moustakas", "sign of the force is corrected"));
}

TEST(AsPublished, ASceneThatDoesNotSuitItsLawIsSaidToNeedMake) {
  const Error law =
      without_its_scene({ErrorCode::usage, "'grid' is not a law of this scene", "--law"}, paper("park"));
  EXPECT_EQ(law.sentence(),
            "--as-published: 'grid' is not a law of this scene; palpable make --as-published park makes a "
            "scene for this paper from its inputs");
  const Error other = without_its_scene({ErrorCode::device, "is gone", "sim"}, paper("park"));
  EXPECT_EQ(other.sentence(), "sim: is gone");
}

TEST(AsPublished, SettingsOfTheUserTakePrecedence) {
  MakeArguments made;
  // Also where they are the defaults.
  made.given = [] { return std::vector<std::string>{"--detail", "--surface", "--steepest", "--resolution"}; };
  made.detail = "relief";
  made.surface = "fused";
  made.steepest_slope = 3.0;
  made.resolution = 128;
  apply_published(paper("gomez"), made);
  EXPECT_EQ(made.detail, "relief");
  EXPECT_EQ(made.steepest_slope, 3.0);
  apply_published(paper("moustakas"), made);
  EXPECT_EQ(made.resolution, 128);
  EXPECT_EQ(made.surface, "fused");
  haptics::LawParameters law;
  law.law = haptics::Law::penalty;
  law.force_shading = 0.25;
  apply_published(paper("moustakas"), law);
  EXPECT_EQ(law.force_shading, 0.25);
}

}  // namespace
}  // namespace palpable::cli
