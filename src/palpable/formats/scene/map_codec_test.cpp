// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/map_codec.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <string>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

StreetMap example_map() {
  StreetMap map;
  map.width_px = 300;
  map.height_px = 200;
  map.streets = {{"Große Straße", 12.5, {{1.25, 2.5}, {100, 50}, {200.75, 60}}}};
  map.junctions = {{{100, 50}, 4, true}};
  map.areas = {{MapArea::Kind::water, {{0, 0}, {10, 0}, {10, 10}}},
               {MapArea::Kind::building, {{20, 0}, {30, 0}, {30, 10}}}};
  map.labels = {{"Große Straße", 0.93, -12.5, {{1, 2}, {50, 2}, {50, 12}, {1, 12}}, true}};
  return map;
}

TEST(MapCodec, ReadsWhatItWrote) {
  const StreetMap map = example_map();
  const auto read = decode_street_map(encode_street_map(map));
  ASSERT_TRUE(read);
  ASSERT_EQ(read->streets.size(), 1U);
  EXPECT_EQ(read->streets[0].name, "Große Straße");
  EXPECT_DOUBLE_EQ(read->streets[0].points[2].x, 200.75);
  EXPECT_DOUBLE_EQ(read->streets[0].width_px, 12.5);
  ASSERT_EQ(read->junctions.size(), 1U);
  EXPECT_TRUE(read->junctions[0].roundabout);
  EXPECT_EQ(read->areas.size(), 2U);
  ASSERT_EQ(read->labels.size(), 1U);
  EXPECT_DOUBLE_EQ(read->labels[0].angle_deg, -12.5);
  EXPECT_TRUE(read->labels[0].names_street);
  EXPECT_EQ(encode_street_map(*read), encode_street_map(map));
}

TEST(MapCodec, ReadsEveryKindOfStreet) {
  StreetMap map = example_map();
  for (const auto kind :
       {MapStreet::Kind::street, MapStreet::Kind::sidewalk, MapStreet::Kind::steps, MapStreet::Kind::path}) {
    map.streets[0].kind = kind;
    const auto read = decode_street_map(encode_street_map(map));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->streets[0].kind, kind);
  }
}

TEST(MapCodec, ReadsSpecialPlacesAndStepsAndSkipsUnknownKinds) {
  StreetMap map = example_map();
  map.streets[0].kind = MapStreet::Kind::steps;
  map.places = {{MapPlace::Kind::church, "St Mary", {3, 4}, {{0, 0}, {6, 0}, {6, 8}}},
                {MapPlace::Kind::crossing, "", {50, 60}, {}, true, false}};
  const Bytes written = encode_street_map(map);
  const auto read = decode_street_map(written);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->streets[0].kind, MapStreet::Kind::steps);
  ASSERT_EQ(read->places.size(), 2U);
  EXPECT_EQ(read->places[0].name, "St Mary");
  EXPECT_EQ(read->places[0].outline.size(), 3U);
  EXPECT_TRUE(read->places[1].tactile_paving);
  EXPECT_FALSE(read->places[1].felt);
  EXPECT_EQ(encode_street_map(*read), written);
  std::string text(as_text(written));
  text.replace(text.find("\"church\""), 8, "\"castle\"");
  const auto later = decode_street_map(as_bytes(text));
  ASSERT_TRUE(later);
  EXPECT_EQ(later->places.size(), 1U);
}

TEST(MapCodec, ReadsNamesAsTheyAreShown) {
  StreetMap map = example_map();
  map.streets[0].name = "\xE2\x80\xAEOld\nRoad\x1b ";
  map.labels.push_back(map.labels[0]);
  map.labels.back().text = " \t ";
  const auto read = decode_street_map(encode_street_map(map));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->streets[0].name, "Old Road");
  EXPECT_EQ(read->labels.size(), 1U);
}

// The JSON library's own conversion to int is undefined for the first, and makes 300 of the second.
TEST(MapCodec, RefusesSizesThatAreNoWholeNumbersInRange) {
  const std::string whole(as_text(encode_street_map(example_map())));
  const auto at = whole.find("\"width_px\":300");
  ASSERT_NE(at, std::string::npos);
  for (const char* wrong : {"3e77", "4294967596", "300.5", "-300", "\"300\"", "null", "[300]"}) {
    std::string text = whole;
    text.replace(at, 14, std::string("\"width_px\":") + wrong);
    EXPECT_FALSE(decode_street_map(as_bytes(text))) << wrong;
  }
}

TEST(MapCodec, RefusesDamagedMaps) {
  const Bytes whole = encode_street_map(example_map());
  EXPECT_FALSE(decode_street_map(std::span(whole).first(whole.size() / 2)));
  EXPECT_FALSE(decode_street_map(as_bytes("{}")));
  std::string text(as_text(whole));
  const auto at = text.find("[200.75,60.0]");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 13, "[1e300,1]");
  EXPECT_FALSE(decode_street_map(as_bytes(text)));
}

}  // namespace
}  // namespace palpable::formats
