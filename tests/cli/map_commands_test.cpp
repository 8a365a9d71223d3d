// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "program.hpp"
#include "test_pictures.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Two streets that cross at (200, 120), white with grey borders, between buildings.
Raster<Rgb8> crossing_streets() {
  constexpr int kWidth = 400;
  constexpr int kHeight = 300;
  Raster<Rgb8> map(kWidth, kHeight, {242, 239, 233});
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (x % 40 > 12 && x % 40 < 32 && y % 40 > 10 && y % 40 < 30) map(x, y) = {217, 208, 201};
      const int nearest = std::min(std::abs(x - 200), std::abs(y - 120));
      if (nearest <= 6) map(x, y) = {190, 190, 190};
      if (nearest <= 5) map(x, y) = {255, 255, 255};
    }
  return map;
}

class MapCommands : public InFolder {
 protected:
  Outcome make(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"make", path("map.png"), "-o",    path("map.palp"),
                                       "--as", "map",           "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return palpable(arguments);
  }
  nlohmann::json info() const { return palpable({"info", path("map.palp"), "--json"}).json(); }
};

TEST_F(MapCommands, MakeAStreetMapThatIsListedDrawnAndTouched) {
  ASSERT_TRUE(formats::write_png(path("map.png"), crossing_streets()));
  const auto made = make();
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.json()["kind"], "map");
  const auto info = palpable({"info", path("map.palp"), "--json"}).json();
  EXPECT_EQ(info["kind"], "map");
  EXPECT_EQ(info["width_px"], 400);
  EXPECT_EQ(info["streets"].size(), 4U);
  ASSERT_EQ(info["crossings"].size(), 1U);
  EXPECT_EQ(info["crossings"][0]["degree"], 4);
  EXPECT_NEAR(info["crossings"][0]["x_px"].get<double>(), 200.0, 2.0);
  EXPECT_NEAR(info["crossings"][0]["y_px"].get<double>(), 120.0, 2.0);
  EXPECT_GT(info["buildings"].size(), 20U);
  const auto shown = palpable({"show", path("map.palp"), "-o", path("shown.png"), "--view", "map"});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  const auto touched = palpable({"touch", path("map.palp"), "--headless", "--seconds", "0.2", "--json"});
  EXPECT_EQ(touched.exit_code, 0) << touched.err;
}

TEST_F(MapCommands, RefuseOtherPicturesWithOneSentence) {
  ASSERT_TRUE(formats::write_png(path("map.png"), unrelated_picture(200, 150, 3)));
  const auto refused = make();
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_TRUE(
      is_one_sentence(palpable({"make", path("map.png"), "-o", path("map.palp"), "--as", "map"}).err));
  EXPECT_THAT(refused.err, HasSubstr("no streets were found"));
  EXPECT_FALSE(std::filesystem::exists(path("map.palp")));
}

TEST_F(MapCommands, TakeTheParametersOfAMapAndOfItsRelief) {
  ASSERT_TRUE(formats::write_png(path("map.png"), crossing_streets()));
  ASSERT_EQ(make().exit_code, 0);
  const auto before = info();
  ASSERT_GT(before["buildings"].size(), 20U);
  // The deepest groove is at 0, and buildings rise above the land.
  EXPECT_NEAR(before["size_m"][2].get<double>(), 0.0015 + 0.0012, 1e-5);
  const auto made = make({"--set", "map.outlines.least_area_px=1000", "--set",
                          "map_relief.street_depth_m=0.002", "--set", "map_relief.samples=256"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, Not(HasSubstr("no effect")));
  const auto after = info();
  EXPECT_EQ(after["streets"].size(), before["streets"].size());
  // The buildings are squares of about twenty pixels.
  EXPECT_EQ(after["buildings"].size(), 0U);
  EXPECT_NEAR(after["size_m"][2].get<double>(), 0.002, 1e-5);
  // Half of all grey levels: streets and land are one colour.
  const auto lost = make({"--set", "map.colours.least_apart=128"});
  EXPECT_EQ(lost.exit_code, 3);
  EXPECT_THAT(lost.err, HasSubstr("no streets were found"));
}

TEST_F(MapCommands, RefuseParametersOutOfTheirRangeAndNameThoseWithoutEffect) {
  ASSERT_TRUE(formats::write_png(path("map.png"), crossing_streets()));
  const auto refusal = [&](const char* assignment) {
    const auto refused = make({"--set", assignment});
    EXPECT_EQ(refused.exit_code, 2) << assignment;
    EXPECT_FALSE(std::filesystem::exists(path("map.palp"))) << assignment;
    return refused.err;
  };
  EXPECT_THAT(refusal("map.colours.most_colours=65"), HasSubstr("must lie between 2 and 64"));
  EXPECT_THAT(refusal("map.colours.most_colours=3.5"), HasSubstr("whole number"));
  EXPECT_THAT(refusal("map.colors.tolerance=9"), HasSubstr("did you mean map.colours.tolerance?"));
  EXPECT_THAT(refusal("map_relief.samples=10"), HasSubstr("must lie between 64 and 4096"));
  EXPECT_THAT(refusal("map_relief.narrowest_street_m=0.01"), HasSubstr("wider than the widest"));
  EXPECT_THAT(refusal("map.text.smallest_letter_px=50"), HasSubstr("text.smallest_letter_px"));
  const auto lines = palpable({"make", path("map.png"), "-o", path("lines.palp"), "--set", "map.dark_land=9",
                               "--set", "map_relief.samples=64"});
  EXPECT_EQ(lines.exit_code, 0) << lines.err;
  EXPECT_THAT(lines.err, HasSubstr("map.dark_land"));
  EXPECT_THAT(lines.err, HasSubstr("map_relief.samples"));
}

TEST_F(MapCommands, ListTheirParameters) {
  for (const char* name : {"map", "map_relief"}) {
    const auto listed = palpable({"methods", name, "--json"}).json();
    EXPECT_EQ(listed["name"], name);
    EXPECT_GT(listed["parameters"].size(), 10U) << name;
  }
  EXPECT_THAT(palpable({"methods", "map"}).out, HasSubstr("map.streets.carriageways.next_width"));
}

TEST_F(MapCommands, RefuseTheMapViewOfOtherScenes) {
  ASSERT_TRUE(formats::write_png(path("map.png"), unrelated_picture(60, 50, 3)));
  ASSERT_EQ(palpable({"make", path("map.png"), "-o", path("lines.palp")}).exit_code, 0);
  const auto shown = palpable({"show", path("lines.palp"), "-o", path("shown.png"), "--view", "map"});
  EXPECT_EQ(shown.exit_code, 2);
  EXPECT_THAT(shown.err, HasSubstr("only the scene of a street map has this view"));
}

TEST_F(MapCommands, MakeAMapOfAnExtract) {
  write_text(path("map.osm"),
             "<?xml version='1.0'?><osm version=\"0.6\">"
             "<node id='1' lat='47.1' lon='9.5'/><node id='2' lat='47.1' lon='9.502'/>"
             "<node id='3' lat='47.101' lon='9.502'/><node id='4' lat='47.1' lon='9.504'/>"
             "<way id='1'><nd ref='1'/><nd ref='2'/><nd ref='4'/><tag k='highway' v='residential'/>"
             "<tag k='name' v='Lindenweg'/></way>"
             "<way id='2'><nd ref='2'/><nd ref='3'/><tag k='highway' v='residential'/></way></osm>");
  const auto made = palpable(
      {"make", path("map.osm"), "-o", path("map.palp"), "--center", "47.1002,9.502", "--width", "300"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto info = palpable({"info", path("map.palp"), "--json"}).json();
  EXPECT_EQ(info["kind"], "map");
  EXPECT_EQ(info["streets"].size(), 3U);
  EXPECT_EQ(info["crossings"].size(), 1U);
  for (const char* file : {"map.txt", "map.svg", "map.brf", "map.pbm", "map.stl"}) {
    const auto exported = palpable({"export", path("map.palp"), "-o", path(file)});
    EXPECT_EQ(exported.exit_code, 0) << exported.err;
    EXPECT_TRUE(std::filesystem::exists(path(file))) << file;
  }
  EXPECT_TRUE(std::filesystem::exists(path("map-key.svg")));
  // An extract's streets are known; its relief is made as that of a picture.
  const auto set = palpable({"make", path("map.osm"), "-o", path("deep.palp"), "--set", "map.dark_land=9",
                             "--set", "map_relief.street_depth_m=0.002"});
  ASSERT_EQ(set.exit_code, 0) << set.err;
  EXPECT_THAT(set.err, HasSubstr("map.dark_land"));
  EXPECT_THAT(set.err, Not(HasSubstr("map_relief")));
  // A name that a person gave has a key, which is not that of a street.
  EXPECT_EQ(palpable({"name", path("map.palp"), "--add", "Linden inn", "--at=10,10"}).exit_code, 0);
  EXPECT_EQ(palpable({"export", path("map.palp"), "-o", path("map.brf")}).exit_code, 0);
  EXPECT_THAT(read_text(path("map.brf")), HasSubstr("LI ,LINDENWEG"));
  EXPECT_THAT(read_text(path("map.brf")), HasSubstr("LIX ,LINDEN INN"));
  // A sheet of an earlier key goes, a file of another kind stays.
  write_text(path("map-key-5.svg"), read_text(path("map-key.svg")));
  write_text(path("map-key-6.svg"), "<svg><title>Mine</title></svg>");
  EXPECT_EQ(palpable({"export", path("map.palp"), "-o", path("map.svg")}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("map-key-5.svg")));
  EXPECT_TRUE(std::filesystem::exists(path("map-key-6.svg")));
  EXPECT_THAT(read_text(path("map.txt")), HasSubstr("300 by 300 metres; north is up"));
  EXPECT_THAT(read_text(path("map.txt")), HasSubstr("Key li: Lindenweg"));
  const auto routed = palpable(
      {"touch", path("map.palp"), "--headless", "--seconds", "0.1", "--route", "Lindenweg to Nowhere"});
  EXPECT_EQ(routed.exit_code, 2);
  EXPECT_THAT(routed.err, HasSubstr("nothing on the map is called 'Nowhere'"));
  const auto far = palpable({"make", path("map.osm"), "-o", path("far.palp"), "--center", "12,13"});
  EXPECT_EQ(far.exit_code, 2);
  EXPECT_THAT(far.err, HasSubstr("outside this extract"));
  write_text(path("empty.osm"), "<?xml version='1.0'?><osm version=\"0.6\"></osm>");
  const auto empty = palpable({"make", path("empty.osm"), "-o", path("empty.palp")});
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_THAT(empty.err, HasSubstr("is an extract without streets"));
}

TEST_F(MapCommands, TheSampleMapHasSpecialPlacesAndLayers) {
  const auto made = palpable({"make", "sample:map", "-o", path("map.palp")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto kinds = [&] {
    std::map<std::string, int> counts;
    const auto listed = info();
    for (const auto& place : listed["special"]) ++counts[place["kind"].get<std::string>()];
    for (const auto& street : listed["streets"]) ++counts[street["kind"].get<std::string>()];
    return counts;
  };
  auto counts = kinds();
  for (const char* const kind : {"church", "station", "hospital", "school", "town_hall", "roundabout"})
    EXPECT_EQ(counts[kind], 1) << kind;
  EXPECT_EQ(counts["bus_stop"], 3);
  EXPECT_EQ(counts["crossing"], 5);
  EXPECT_EQ(counts["steps"], 1);
  EXPECT_EQ(counts["entrance"], 0);
  bool is_felt = false;
  const auto described = info();
  for (const auto& material : described["materials"])
    is_felt = is_felt || material["name"] == "Oldbridge Station";
  EXPECT_TRUE(is_felt);
  ASSERT_EQ(palpable({"export", path("map.palp"), "-o", path("map.txt")}).exit_code, 0);
  EXPECT_THAT(read_text(path("map.txt")), HasSubstr("St Anne's Church"));
  ASSERT_EQ(palpable({"make", "sample:map", "-o", path("map.palp"), "--layers", "entrances"}).exit_code, 0);
  counts = kinds();
  EXPECT_EQ(counts["entrance"], 2);
  EXPECT_EQ(counts["crossing"], 0);
  EXPECT_EQ(counts["steps"], 0);
  const auto refused = palpable({"make", "sample:map", "-o", path("map.palp"), "--layers", "stops,trees"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("'trees' is no layer of a map"));
}

TEST_F(MapCommands, ARouteIsPulledRecordedAndRecomputed) {
  const auto touched = palpable({"touch", "sample:map", "--route", "Mill Lane to Church Lane", "--headless",
                                 "--seconds", "0.5", "--record", path("touch.rec"), "--json"});
  ASSERT_EQ(touched.exit_code, 0) << touched.err;
  EXPECT_THAT(touched.err, HasSubstr("The route from Mill Lane to Church Lane"));
  ASSERT_EQ(palpable({"make", "sample:map", "-o", path("map.palp")}).exit_code, 0);
  const auto checked = palpable({"check", path("touch.rec"), path("map.palp")});
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  const auto refused = palpable({"touch", "sample:map", "--pull", "0.2", "--headless", "--seconds", "0.1"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--route"));
}

}  // namespace
}  // namespace palpable::test
