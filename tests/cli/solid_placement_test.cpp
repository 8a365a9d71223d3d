// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Placement of solids by the real program: size, up direction, and open sheets.
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "program.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A box with one corner at the given place, triangles oriented outwards.
std::string box_obj(double x, double y, double z, double left = 0.0, double bottom = 0.0) {
  std::string obj;
  for (int k = 0; k < 8; ++k)
    obj += "v " + std::to_string(left + ((k & 1) != 0 ? x : 0.0)) + ' ' +
           std::to_string(bottom + ((k & 2) != 0 ? y : 0.0)) + ' ' + std::to_string((k & 4) != 0 ? z : 0.0) +
           '\n';
  return obj +
         "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\nf 3 5 7\nf 2 4 6\n"
         "f 4 8 6\n";
}

class SolidPlacement : public InFolder {
 protected:
  Outcome make(const std::string& input, const std::vector<std::string>& more = {},
               const std::string& resolution = "32") {
    std::vector<std::string> arguments{"make", input, "-o", path("out.palp"), "--resolution", resolution};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return palpable(arguments);
  }
  nlohmann::json info() { return palpable({"info", path("out.palp"), "--json"}).json(); }
  void expect_size_mm(double width, double height, double depth) {
    const auto size = info().at("size_m");
    EXPECT_NEAR(size[0].get<double>(), 0.001 * width, 1e-6);
    EXPECT_NEAR(size[1].get<double>(), 0.001 * height, 1e-6);
    EXPECT_NEAR(size[2].get<double>(), 0.001 * depth, 1e-6);
  }
};

TEST_F(SolidPlacement, AMeshWithoutUnitsIsFittedWithAMessage) {
  write_text(path("m.obj"), box_obj(8.0, 6.0, 10.0));
  const Outcome outcome = make(path("m.obj"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("states no unit"));
  expect_size_mm(40.0, 30.0, 50.0);
  EXPECT_NEAR(info().at("scene_from_input")[0][0].get<double>(), 0.005, 1e-9);
}

TEST_F(SolidPlacement, AMeshOfAHandsSizeFarFromItsOriginIsCentred) {
  write_text(path("m.obj"), box_obj(0.08, 0.06, 0.1, 0.3, 0.3));
  const Outcome outcome = make(path("m.obj"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("it was centred"));
  expect_size_mm(80.0, 60.0, 100.0);
  EXPECT_NEAR(info().at("scene_from_input")[0][3].get<double>(), -0.34, 1e-6);
}

TEST_F(SolidPlacement, AMeshOfAHandsSizeKeepsItsMetresAndOrigin) {
  write_text(path("m.obj"), box_obj(0.08, 0.06, 0.1, -0.04, -0.03));
  const Outcome outcome = make(path("m.obj"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("states no unit: its coordinates were taken as metres"));
  expect_size_mm(80.0, 60.0, 100.0);
  EXPECT_EQ(info().at("scene_from_input")[0][3].get<double>(), 0.0);
}

TEST_F(SolidPlacement, UpFollowsTheFormatsConventionOrTheOption) {
  // STL: 8 wide, 10 deep, 6 high along z.
  write_text(path("m.obj"), box_obj(8.0, 10.0, 6.0));
  ASSERT_EQ(make(path("m.obj"), {"--up", "z"}).exit_code, 0);
  expect_size_mm(40.0, 30.0, 50.0);
  ASSERT_EQ(make(path("m.obj"), {"--up", "z", "--lay", "flat"}).exit_code, 0);
  expect_size_mm(66.6667, 83.3333, 50.0);
  EXPECT_EQ(make(path("m.obj"), {"--up", "w"}).exit_code, 2);
}

TEST_F(SolidPlacement, AnOpenSheetBecomesAReliefWithAMessage) {
  // A flat map with y up: two rectangles, together 100 wide.
  write_text(path("m.obj"),
             "v 0 0 0\nv 40 0 0\nv 40 0 40\nv 0 0 40\nv 60 0 0\nv 100 0 0\nv 100 0 40\nv 60 0 40\n"
             "f 1 4 3\nf 1 3 2\nf 5 8 7\nf 5 7 6\n");
  const Outcome outcome = make(path("m.obj"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("open sheet"));
  EXPECT_EQ(info().at("kind"), "relief");
  write_text(path("q.csv"), "x_m,y_m,z_m\n0.03,0,0.01\n0,0,0.01\n");
  ASSERT_EQ(palpable({"sample", path("out.palp"), "--points", path("q.csv"), "-o", path("v.csv")}).exit_code,
            0);
  // As a solid, it is a thin wall.
  const Outcome field = make(path("m.obj"), {"--as", "field"});
  ASSERT_EQ(field.exit_code, 0) << field.err;
  EXPECT_THAT(field.err, HasSubstr("2 open sheets, with air on both sides, were given a thickness"));
  EXPECT_EQ(make(path("m.obj"), {"--as", "field", "--dense"}).exit_code, 3);
}

/// Boxes in one mesh: left, bottom, back, and right, top, front; metres.
std::string boxes_obj(const std::vector<std::array<double, 6>>& boxes) {
  std::string obj;
  int first = 0;
  for (const auto& b : boxes) {
    for (unsigned k = 0; k < 8; ++k)
      obj += "v " + std::to_string(b[(k & 1U) != 0 ? 3 : 0]) + ' ' +
             std::to_string(b[(k & 2U) != 0 ? 4 : 1]) + ' ' + std::to_string(b[(k & 4U) != 0 ? 5 : 2]) + '\n';
    for (const auto& [x, y, z] : std::vector<std::array<int, 3>>{{1, 3, 2},
                                                                 {2, 3, 4},
                                                                 {5, 6, 7},
                                                                 {6, 8, 7},
                                                                 {1, 2, 5},
                                                                 {2, 6, 5},
                                                                 {3, 7, 4},
                                                                 {4, 7, 8},
                                                                 {1, 5, 3},
                                                                 {3, 5, 7},
                                                                 {2, 4, 6},
                                                                 {4, 8, 6}})
      obj += "f " + std::to_string(first + x) + ' ' + std::to_string(first + y) + ' ' +
             std::to_string(first + z) + '\n';
    first += 8;
  }
  return obj;
}

TEST_F(SolidPlacement, ASmallCityLiesFlatAndItsTowersAreCounted) {
  write_text(path("m.obj"), boxes_obj({{-0.05, -0.002, -0.04, 0.05, 0.002, 0.04},
                                       {-0.035, 0.002, -0.025, -0.025, 0.032, -0.015},
                                       {0.01, 0.002, 0.01, 0.03, 0.014, 0.03},
                                       {0.026, 0.002, -0.029, 0.034, 0.022, -0.021}}));
  const Outcome outcome = make(path("m.obj"), {}, "128");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("most of its surface is level: it lies flat, seen from above"));
  expect_size_mm(100.0, 80.0, 34.0);
  write_text(path("keys"), "dq");
  Running touch({"touch", path("out.palp"), "--headless", "--keys", "--seconds", "20"}, path("keys"));
  EXPECT_THAT(touch.wait().out,
              HasSubstr("3 parts rise: upper left; upper right; lower right. Highest place: "
                        "upper left, 34 millimetres above its base."));
}

TEST_F(SolidPlacement, ALowSolidSeenFromTheFrontComesWithAdvice) {
  // A low comb of eight walls: hardly anything of it is level.
  std::vector<std::array<double, 6>> walls;
  for (int k = 0; k < 8; ++k) walls.push_back({-0.04 + 0.01 * k, 0.0, -0.04, -0.038 + 0.01 * k, 0.03, 0.04});
  write_text(path("m.obj"), boxes_obj(walls));
  EXPECT_THAT(make(path("m.obj")).err, HasSubstr("is seen from the front (--lay flat shows it from above)"));
  EXPECT_THAT(make(path("m.obj"), {"--lay", "upright"}).err, Not(HasSubstr("--lay flat shows")));
}

TEST_F(SolidPlacement, ATableOnTheOriginIsDescribedByItsOwnBox) {
  // A board on four legs; its foot is at the origin's height.
  write_text(path("m.obj"), boxes_obj({{-0.04, 0.0375, -0.025, 0.04, 0.0425, 0.025},
                                       {-0.0375, 0.0, -0.022, -0.0325, 0.038, -0.017},
                                       {0.0325, 0.0, -0.022, 0.0375, 0.038, -0.017},
                                       {-0.0375, 0.0, 0.017, -0.0325, 0.038, 0.022},
                                       {0.0325, 0.0, 0.017, 0.0375, 0.038, 0.022}}));
  ASSERT_EQ(make(path("m.obj"), {}, "128").exit_code, 0);
  write_text(path("keys"), "dddq");
  Running touch({"touch", path("out.palp"), "--headless", "--keys", "--seconds", "20"}, path("keys"));
  const std::string words = touch.wait().out;
  EXPECT_THAT(words, HasSubstr("Nearest place: upper middle, 50 millimetres from its back."));
  EXPECT_THAT(words, HasSubstr("Middle third, left to right: 47, nothing, 47."));
}

TEST_F(SolidPlacement, ADeepMeshFillsTheFaceOfAReliefAndIsFlattened) {
  write_text(path("m.obj"), box_obj(1.0, 2.0, 2.0));
  const Outcome outcome = make(path("m.obj"), {"--as", "relief"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("its heights were divided by 7.1"));
  expect_size_mm(50.0, 100.0, 15.0);
}

TEST_F(SolidPlacement, TheExtentTowardsThePersonIsCalledAsTheSolidLies) {
  write_text(path("m.obj"), box_obj(1.0, 1.0, 0.5));
  write_text(path("keys"), "dq");
  for (const auto& [lay, words] : {std::pair("upright", "100 millimetres high and 50 millimetres deep"),
                                   std::pair("flat", "50 millimetres deep and 100 millimetres high")}) {
    ASSERT_EQ(make(path("m.obj"), {"--lay", lay, "--size", "100x100x100"}).exit_code, 0);
    Running touch({"touch", path("out.palp"), "--headless", "--keys", "--seconds", "20"}, path("keys"));
    const Outcome outcome = touch.wait();
    EXPECT_THAT(outcome.out + outcome.err, HasSubstr(words)) << lay;
  }
}

TEST_F(SolidPlacement, ABoxThatFillsItsBoundingBoxIsDrawnFromAllSides) {
  write_text(path("m.obj"), box_obj(1.0, 1.0, 1.0));
  for (const char* size : {"100x100x100", "100x100x50", "30x30x30"}) {
    ASSERT_EQ(make(path("m.obj"), {"--size", size}).exit_code, 0);
    for (const char* view : {"relief", "depth", "force", "section"}) {
      const Outcome shown = palpable({"show", path("out.palp"), "-o", path("p.png"), "--view", view});
      EXPECT_EQ(shown.exit_code, 0) << size << ' ' << view << ' ' << shown.err;
    }
  }
  // In perspective, which takes ten times as long, at the last of these sizes alone.
  const Outcome solid = palpable({"show", path("out.palp"), "-o", path("p.png"), "--view", "solid"});
  EXPECT_EQ(solid.exit_code, 0) << solid.err;
}

TEST_F(SolidPlacement, ASolidIsDrawnInPerspectiveUnlessAViewIsGiven) {
  write_text(path("m.obj"), box_obj(0.08, 0.06, 0.05));
  ASSERT_EQ(make(path("m.obj")).exit_code, 0);
  const auto drawn = palpable({"show", path("out.palp"), "-o", path("out.png"), "--json"}).json();
  EXPECT_EQ(drawn["view"], "solid");
  const auto section = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words{"show", path("out.palp"), "-o", path(name), "--view", "section"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(palpable(words).exit_code, 0);
    return read_text(path(name));
  };
  EXPECT_NE(section("plain.png", {}), section("cells.png", {"--cells"}));
}

TEST_F(SolidPlacement, OnlyFieldsAreDrawnAsSolids) {
  write_text(path("m.obj"), box_obj(1.0, 1.0, 1.0));
  ASSERT_EQ(make(path("m.obj"), {"--as", "relief"}).exit_code, 0);
  const Outcome shown = palpable({"show", path("out.palp"), "-o", path("p.png"), "--view", "solid"});
  EXPECT_EQ(shown.exit_code, 2);
  EXPECT_TRUE(is_one_sentence(shown.err)) << shown.err;
}

TEST_F(SolidPlacement, RealMeshesFillTheirDepth) {
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
  for (const char* mesh : {"/mesh/objects/spot.obj", "/mesh/kenney_city/building-small-a.glb"})
    for (const char* size : {"100x100x100", "100x100x50"}) {
      ASSERT_EQ(make(data + std::string(mesh), {"--size", size}).exit_code, 0) << mesh;
      const Outcome shown = palpable({"show", path("out.palp"), "-o", path("p.png"), "--view", "relief"});
      EXPECT_EQ(shown.exit_code, 0) << mesh << ' ' << size << shown.err;
    }
  const Outcome map = make(data + std::string("/mesh/touchmapper_map/map.obj"));
  ASSERT_EQ(map.exit_code, 0) << map.err;
  EXPECT_EQ(info().at("kind"), "relief");
}

}  // namespace
}  // namespace palpable::test
