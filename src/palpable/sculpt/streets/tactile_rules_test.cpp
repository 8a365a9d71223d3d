// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/tactile_rules.hpp"

#include "palpable/sculpt/streets/street_relief.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

using Rule = TactileViolation::Rule;

/// A plate of 40 x 40 mm, ten samples to a millimetre, with land at 2 mm.
class Plate {
 public:
  void box(MapPart part, double left_mm, double top_mm, double wide_mm, double high_mm, double height_mm) {
    for (int y = 0; y < 400; ++y)
      for (int x = 0; x < 400; ++x)
        if (x >= 10 * left_mm && x < 10 * (left_mm + wide_mm) && y >= 10 * top_mm &&
            y < 10 * (top_mm + high_mm)) {
          heights_(x, y) = static_cast<float>(0.002 + 0.001 * height_mm);
          parts_(x, y) = part;
        }
  }
  std::vector<TactileViolation> check() const {
    return check_tactile_rules(*models::Relief::from_samples(heights_, 0.0001), parts_, {});
  }

 private:
  Raster<float> heights_{400, 400, 0.002F};
  Raster<MapPart> parts_{400, 400, MapPart::land};
};

int count(const std::vector<TactileViolation>& found, Rule rule, MapPart part) {
  return static_cast<int>(std::count_if(found.begin(), found.end(), [&](const TactileViolation& v) {
    return v.rule == rule && v.part == part;
  }));
}

TEST(TactileRules, FindNothingOnAGoodPlate) {
  Plate plate;
  plate.box(MapPart::street, 0, 10, 40, 3, -1.5);
  plate.box(MapPart::street, 0, 17, 40, 3, -1.5);
  plate.box(MapPart::building, 5, 25, 4, 4, 1.0);
  plate.box(MapPart::building, 13, 25, 4, 4, 1.0);
  plate.box(MapPart::water, 25, 25, 6, 6, -0.9);
  EXPECT_TRUE(plate.check().empty());
}

TEST(TactileRules, FindWhatIsTooLow) {
  Plate plate;
  plate.box(MapPart::street, 0, 10, 40, 3, -0.7);
  plate.box(MapPart::building, 5, 25, 4, 4, 0.5);
  plate.box(MapPart::water, 25, 25, 6, 6, -0.6);
  const auto found = plate.check();
  EXPECT_EQ(found.size(), 3U);
  for (const MapPart part : {MapPart::street, MapPart::building, MapPart::water})
    EXPECT_EQ(count(found, Rule::low_relief, part), 1);
  for (const auto& v : found)
    if (v.part == MapPart::building) {
      EXPECT_NEAR(v.measured_m, 0.0005, 1e-5);
      // 5 to 9 mm from the left, 25 to 29 from the top.
      EXPECT_TRUE(v.x_m > -0.0151 && v.x_m < -0.0109);
      EXPECT_TRUE(v.y_m < -0.0049 && v.y_m > -0.0091);
    }
}

TEST(TactileRules, FindAGrooveThatBecomesFlatInAPart) {
  Plate plate;
  plate.box(MapPart::street, 0, 10, 40, 3, -1.5);
  plate.box(MapPart::street, 15, 10, 10, 3, -0.3);
  const auto found = plate.check();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].rule, Rule::low_relief);
  EXPECT_NEAR(found[0].x_m, 0.0, 0.006);
}

TEST(TactileRules, FindNarrowGaps) {
  Plate plate;
  // A ridge of 2 mm between grooves, 2 mm between buildings, 2 mm from water to a groove.
  plate.box(MapPart::street, 0, 3, 40, 3, -1.5);
  plate.box(MapPart::street, 0, 8, 40, 3, -1.5);
  plate.box(MapPart::building, 5, 25, 4, 4, 1.0);
  plate.box(MapPart::building, 11, 25, 4, 4, 1.0);
  plate.box(MapPart::water, 25, 13, 6, 6, -0.9);
  const auto found = plate.check();
  EXPECT_EQ(found.size(), 3U);
  EXPECT_EQ(count(found, Rule::narrow_gap, MapPart::street), 1);
  EXPECT_EQ(count(found, Rule::narrow_gap, MapPart::building), 1);
  EXPECT_EQ(count(found, Rule::narrow_gap, MapPart::water), 1);
  for (const auto& v : found) EXPECT_NEAR(v.measured_m, 0.002, 0.00015);
}

TEST(TactileRules, FindNarrowGroovesAndCrumbs) {
  Plate plate;
  plate.box(MapPart::street, 0, 10, 40, 2, -1.5);
  plate.box(MapPart::building, 5, 25, 2, 8, 1.0);
  plate.box(MapPart::water, 25, 25, 8, 2, -0.9);
  const auto found = plate.check();
  EXPECT_EQ(count(found, Rule::narrow_groove, MapPart::street), 1);
  EXPECT_EQ(count(found, Rule::small_part, MapPart::building), 1);
  EXPECT_EQ(count(found, Rule::small_part, MapPart::water), 1);
  EXPECT_EQ(found.size(), 3U);
}

TEST(TactileRules, MeasureThePartOfThePlateInHollows) {
  Raster<MapPart> parts(400, 400, MapPart::land);
  const auto box = [&parts](int left, int top, int wide, int high) {
    for (int y = top; y < top + high; ++y)
      for (int x = left; x < left + wide; ++x) parts(x, y) = MapPart::street;
  };
  // A crossing of two grooves of 6 mm is none.
  box(0, 50, 400, 60);
  box(50, 0, 60, 400);
  EXPECT_DOUBLE_EQ(hollow_part(parts, 0.0001, {}), 0.0);
  // A hollow of 15 x 20 mm on a plate of 40 x 40 mm, without its corners of a radius of 5 mm.
  box(200, 150, 150, 200);
  const double corners = (4.0 - 3.14159265) * 25.0;
  EXPECT_NEAR(hollow_part(parts, 0.0001, {}), (300.0 - corners) / 1600.0, 0.005);
  TactileRules wide;
  wide.hollow_m = 0.016;
  EXPECT_DOUBLE_EQ(hollow_part(parts, 0.0001, wide), 0.0);
}

TEST(TactileRules, ACornerOfLandIsNoNarrowGap) {
  Plate plate;
  plate.box(MapPart::street, 0, 18, 40, 3, -1.5);
  plate.box(MapPart::street, 18, 0, 3, 40, -1.5);
  EXPECT_TRUE(plate.check().empty());
}

/// A town of bent streets, lanes beside them, blocks of houses and ponds, at random; `metres` wide.
StreetMap random_town(unsigned seed, double metres) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  StreetMap map;
  map.width_px = map.height_px = 1024;
  const double px = 1024.0 / metres;
  const auto inside = [](MapPoint p) { return p.x >= 0 && p.y >= 0 && p.x <= 1023 && p.y <= 1023; };
  const double turn = uniform(-0.5, 0.5), block_m = uniform(60.0, 130.0);
  const auto at = [&](double u, double v) {
    const double x = (std::cos(turn) * u - std::sin(turn) * v) * px + 512.0;
    const double y = (std::sin(turn) * u + std::cos(turn) * v) * px + 512.0;
    return MapPoint{x, y};
  };
  const int half = static_cast<int>(metres / block_m) + 1;
  for (int i = -half; i <= half; ++i)
    for (const bool across : {false, true}) {
      const std::string name = (across ? "Row " : "Column ") + std::to_string(i);
      const double width_m = i % 4 == 0 ? 12.0 : 6.0;
      for (int k = -half; k < half; ++k) {
        const auto place = [&](double along, double off) {
          const double u = along * block_m, v = i * block_m + off;
          return across ? at(u, v) : at(v, u);
        };
        const MapPoint a = place(k, 0), b = place(k + 0.5, uniform(-8, 8)), c = place(k + 1, 0);
        if (inside(a) && inside(b) && inside(c) && uniform(0, 1) < 0.85)
          map.streets.push_back({name, width_m * px, {a, b, c}});
        // A second carriageway, and lanes at odd angles.
        const MapPoint d = place(k, 14), e = place(k + 1, 14);
        if (i % 8 == 0 && inside(d) && inside(e)) map.streets.push_back({name, width_m * px, {d, e}});
        const MapPoint f = place(k + uniform(0, 1), uniform(0, block_m));
        if (inside(a) && inside(f) && uniform(0, 1) < 0.3) map.streets.push_back({"", 4.0 * px, {a, f}});
      }
    }
  for (int i = 0; i < 600; ++i) {
    const MapPoint p{uniform(0, 1000), uniform(0, 1000)};
    const double w = uniform(6, 30) * px, h = uniform(6, 30) * px;
    const auto kind = i % 20 == 0 ? MapArea::Kind::water : MapArea::Kind::building;
    map.areas.push_back({kind, {p, {p.x + w, p.y}, {p.x + w, p.y + h}, {p.x, p.y + h}}});
  }
  return map;
}

TEST(TactileRules, HoldOnFinishedMapsAtEveryWidth) {
  for (const double metres : {300.0, 600.0, 1200.0, 4000.0})
    for (const unsigned seed : {1U}) {
      const StreetMap map = random_town(seed, metres);
      const auto made = relief_from_street_map(map, {});
      ASSERT_TRUE(made);
      const auto found = check_tactile_rules(made->relief, made->parts, {});
      EXPECT_TRUE(found.empty()) << metres << " m, seed " << seed << ": " << found.size();
      for (std::size_t k = 0; k < std::min<std::size_t>(found.size(), 5); ++k)
        ADD_FAILURE() << words_of(found[k].rule) << " " << static_cast<int>(found[k].part) << " at "
                      << 1000 * found[k].x_m << ", " << 1000 * found[k].y_m << ": "
                      << 1000 * found[k].measured_m;
      // Streets are felt at every width.
      EXPECT_GT(std::count(made->streets.felt.begin(), made->streets.felt.end(), true), 4);
    }
}

TEST(TactileRules, ASecondCarriagewayIsMergedAndALaneBesideAStreetLeftOut) {
  StreetMap map;
  map.width_px = map.height_px = 1000;
  map.streets = {{"Main Road", 40.0, {{0, 300}, {999, 300}}},
                 {"Main Road", 40.0, {{0, 350}, {999, 350}}},
                 {"Back Lane", 20.0, {{0, 260}, {999, 260}}},
                 {"Far Street", 20.0, {{0, 700}, {999, 700}}}};
  const auto made = relief_from_street_map(map, {});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->streets.felt, (std::vector<bool>{true, false, false, true}));
  EXPECT_EQ(made->streets.merged, 1U);
  EXPECT_EQ(made->streets.left_out, 1U);
  EXPECT_EQ(made->streets.left_out_names, std::vector<std::string>{"Back Lane"});
}

}  // namespace
}  // namespace palpable::sculpt
