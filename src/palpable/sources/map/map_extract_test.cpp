// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/map/map_extract.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/isolated/isolated.hpp"
#include "palpable/sources/map/extract_reply.hpp"
#include "palpable/sources/map/extract_window.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

using ::testing::HasSubstr;

// Main Street from west to east in two ways, Side Street to the north from its middle, a footpath, and a
// building of 20 m. A hundred-thousandth of a degree is 1.11 m at the equator.
const std::string kCrossing = R"(<?xml version='1.0' encoding='UTF-8'?>
<osm version="0.6">
<node id="1" lat="0" lon="-0.002"/><node id="2" lat="0" lon="0"/><node id="3" lat="0" lon="0.001"/>
<node id="4" lat="0" lon="0.01"/><node id="5" lat="0.002" lon="0"/><node id="6" lat="-0.001" lon="0"/>
<node id="11" lat="0.0005" lon="0.0005"/><node id="12" lat="0.0005" lon="0.0007"/>
<node id="13" lat="0.0007" lon="0.0007"/><node id="14" lat="0.0007" lon="0.0005"/>
<way id="100"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="highway" v="residential"/><tag k="name" v="Main Street"/></way>
<way id="101"><nd ref="3"/><nd ref="4"/><tag k="highway" v="residential"/><tag k="name" v="Main Street"/></way>
<way id="102"><nd ref="2"/><nd ref="5"/><tag k="highway" v="tertiary"/><tag k="name" v="Side Street"/><tag k="width" v="7.5 m"/></way>
<way id="103"><nd ref="2"/><nd ref="6"/><nd ref="99"/><tag k="highway" v="footway"/></way>
<way id="104"><nd ref="11"/><nd ref="12"/><nd ref="13"/><nd ref="14"/><nd ref="11"/><tag k="building" v="yes"/></way>
</osm>
)";

Result<MapExtract> parsed(const std::string& text) {
  const auto reply = isolated::decode(isolated::Job::map_extract, as_bytes(text));
  if (!reply) return reply.error();
  return isolated::map_extract_in(reply->bytes());
}

ExtractWindow window_at(double latitude, double longitude, double width_m) {
  ExtractWindow window;
  window.center = GeoPoint{latitude, longitude};
  window.width_m = width_m;
  window.side_px = 400;
  return window;
}

TEST(MapExtractFile, WaysAndAreasAreReadWithTheirNamesAndPlaces) {
  const auto extract = parsed(kCrossing);
  ASSERT_TRUE(extract) << extract.error().sentence();
  ASSERT_EQ(extract->ways.size(), 4U);
  EXPECT_EQ(extract->ways[0].name, "Main Street");
  EXPECT_EQ(extract->ways[2].width_m, 7.5);
  EXPECT_EQ(extract->ways[3].kind, "footway");
  // The node that is not in the extract is left out.
  EXPECT_EQ(extract->ways[3].points.size(), 2U);
  ASSERT_EQ(extract->areas.size(), 1U);
  EXPECT_EQ(extract->areas[0].ring.size(), 4U);
}

/// Main Street as one way through nodes 2 and 3, `times` there and back.
std::string there_and_back(int times) {
  std::string text = kCrossing.substr(0, kCrossing.find("<way id=\"100\">")) + "<way id=\"100\">";
  for (int k = 0; k < times; ++k) text += "<nd ref=\"2\"/><nd ref=\"3\"/>";
  return text + "<tag k=\"highway\" v=\"residential\"/></way></osm>";
}

TEST(MapExtractFile, AWayOfMoreNodesThanAnyIsRefused) {
  const auto extract = parsed(there_and_back(50'001));
  ASSERT_FALSE(extract);
  EXPECT_THAT(extract.error().message, HasSubstr("a way of 100002 nodes"));
}

TEST(MapExtractFile, AWindowOfMoreStreetsThanAnyIsRefused) {
  std::string text = there_and_back(50'000);
  const auto begin = text.find("<way"), end = text.find("</osm>");
  const std::string way = text.substr(begin, end - begin);
  for (const char* number : {"101", "102"}) {
    std::string other = way;
    text.insert(text.find("</osm>"), other.replace(other.find("100"), 3, number));
  }
  const auto extract = parsed(text);
  ASSERT_TRUE(extract) << extract.error().sentence();
  const auto map = street_map_of(*extract, window_at(0.0, 0.0005, 300.0));
  ASSERT_FALSE(map);
  EXPECT_THAT(map.error().message, HasSubstr("streets in 300 m"));
}

TEST(MapExtractFile, NodesAfterTheirWaysAndBelowZeroAreFound) {
  const auto extract = parsed(R"(<?xml version='1.0'?><osm version="0.6">
<way id="-1"><nd ref="-2"/><nd ref="3"/><tag k="highway" v="residential"/><tag k="width" v="40 ft"/></way>
<way id="2" visible="false"><nd ref="-2"/><nd ref="3"/><tag k="highway" v="residential"/></way>
<node id="-2" lat="0" lon="0"/><node id="3" lat="0" lon="0.001"/></osm>)");
  ASSERT_TRUE(extract) << extract.error().sentence();
  ASSERT_EQ(extract->ways.size(), 1U) << "without the deleted one";
  EXPECT_EQ(extract->ways[0].points.size(), 2U);
  EXPECT_NEAR(extract->ways[0].width_m, 12.192, 1e-9);
}

TEST(MapExtractFile, AWayIsDividedWhereANodeIsMissing) {
  const auto extract = parsed(R"(<?xml version='1.0'?><osm version="0.6">
<node id="1" lat="0" lon="0"/><node id="2" lat="0" lon="0.001"/>
<node id="4" lat="0.005" lon="0.003"/><node id="5" lat="0.005" lon="0.004"/>
<way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="5"/><tag k="highway" v="residential"/></way></osm>)");
  ASSERT_TRUE(extract) << extract.error().sentence();
  ASSERT_EQ(extract->ways.size(), 2U);
  EXPECT_EQ(extract->ways[1].nodes, (std::vector<std::int64_t>{4, 5}));
}

TEST(MapExtractFile, DamagedFilesAreRefused) {
  for (const std::string& text :
       {std::string("<?xml version='1.0'?><osm version=\"0.6\"><node id=\"1\" lat="),
        std::string("\0\0\0\x0D\x0A\x09OSMHeader\x18\x7F garbage", 25),
        std::string("<osm version=\"0.6\">")}) {
    const auto extract = parsed(text);
    ASSERT_FALSE(extract);
    EXPECT_EQ(extract.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(extract.error().message, HasSubstr("damaged"));
  }
}

TEST(ExtractWindow, StreetsAreDividedAtJunctionsAndJoinedElsewhere) {
  const auto extract = parsed(kCrossing);
  ASSERT_TRUE(extract);
  const auto window = street_map_of(*extract, window_at(0.0, 0.0, 400.0));
  ASSERT_TRUE(window) << window.error().sentence();
  const StreetMap& map = window->map;
  // The footpath is no street; the two ways of Main Street are one piece east of the junction.
  ASSERT_EQ(map.streets.size(), 3U);
  ASSERT_EQ(map.junctions.size(), 1U);
  EXPECT_EQ(map.junctions[0].degree, 3);
  EXPECT_NEAR(map.junctions[0].at.x, 199.5, 1e-6);
  EXPECT_NEAR(map.junctions[0].at.y, 199.5, 1e-6);
  for (const MapStreet& street : map.streets) {
    EXPECT_NEAR(street.width_px, street.name == "Side Street" ? 7.5 : 6.0, 1e-9);
    for (const MapPoint p : street.points) {
      EXPECT_GE(std::min(p.x, p.y), 0.0);
      EXPECT_LE(std::max(p.x, p.y), 399.0);
    }
  }
  ASSERT_EQ(map.areas.size(), 1U);
  // 0.0005 degrees are 55.6 m, to the right and up.
  EXPECT_NEAR(map.areas[0].outline[0].x, 199.5 + 55.6, 0.1);
  EXPECT_NEAR(map.areas[0].outline[0].y, 199.5 - 55.6, 0.1);
}

TEST(ExtractWindow, WithoutACentreItIsWhereMostStreetsAre) {
  const auto extract = parsed(kCrossing);
  ASSERT_TRUE(extract);
  const auto window = street_map_of(*extract, {});
  ASSERT_TRUE(window) << window.error().sentence();
  ASSERT_EQ(window->notes.size(), 1U);
  EXPECT_THAT(window->notes[0].sentence, HasSubstr("600 m around 0.00000,0.00000"));
}

TEST(ExtractWindow, WithoutACentreItIsOnAStreetEvenIfTheMedianIsNot) {
  // Three streets: the median latitude is that of the second one, the median longitude that of the first.
  MapExtract extract;
  std::int64_t node = 0;
  for (const GeoPoint at : {GeoPoint{0.0, 0.1}, GeoPoint{0.1, 0.2}, GeoPoint{0.2, 0.0}}) {
    extract.ways.push_back(
        {"residential", "", 0.0, false, false, {node, node + 1}, {at, {at.latitude + 0.001, at.longitude}}});
    node += 2;
  }
  const auto made = street_map_of(extract, {});
  EXPECT_TRUE(made) << made.error().sentence();
}

TEST(ExtractWindow, GoesOnAcrossTheDateLine) {
  MapExtract extract;
  extract.ways.push_back({"residential",
                          "Date Line Road",
                          0.0,
                          false,
                          false,
                          {1, 2, 3},
                          {{0.0, 179.999}, {0.0, 180.0}, {0.0, -179.999}}});
  for (const double longitude : {180.0, -180.0, 179.9995}) {
    const auto made = street_map_of(extract, window_at(0.0, longitude, 600.0));
    ASSERT_TRUE(made) << made.error().sentence();
    double west = 1e9, east = -1e9;
    for (const MapStreet& street : made->map.streets)
      for (const MapPoint p : street.points) west = std::min(west, p.x), east = std::max(east, p.x);
    // 0.002 degrees at 111195 m are 222 m of the window's 600.
    EXPECT_NEAR(east - west, 400.0 * 222.39 / 600.0, 1.0) << longitude;
  }
}

TEST(ExtractWindow, RefusesAnEmptyExtractAndACentreOutsideIt) {
  const auto empty = parsed("<?xml version='1.0'?><osm version=\"0.6\"></osm>");
  ASSERT_TRUE(empty) << empty.error().sentence();
  const auto none = street_map_of(*empty, {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "is an extract without streets");
  const auto extract = parsed(kCrossing);
  ASSERT_TRUE(extract);
  const auto outside = street_map_of(*extract, window_at(47.14, 9.52, 400.0));
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().code, ErrorCode::usage);
  EXPECT_THAT(outside.error().message, HasSubstr("outside this extract"));
  const auto bare = street_map_of(*extract, window_at(0.001, 0.007, 60.0));
  ASSERT_FALSE(bare);
  EXPECT_THAT(bare.error().message, HasSubstr("no streets in the 60 m around"));
  EXPECT_FALSE(street_map_of(*extract, window_at(0.0, 0.0, 1.0)));
}

// High Street from west to east through a roundabout of 20 m at its middle, whose ring is in two ways; a
// church, a hospital's grounds, a station twice, a crossing, a bus stop, an entrance, steps and a sidewalk.
const std::string kPlaces = R"(<?xml version='1.0' encoding='UTF-8'?>
<osm version="0.6">
<node id="1" lat="0" lon="-0.002"/><node id="2" lat="0" lon="-0.0001"/><node id="3" lat="0.0001" lon="0"/>
<node id="4" lat="0" lon="0.0001"/><node id="5" lat="-0.0001" lon="0"/><node id="6" lat="0" lon="0.002"/>
<node id="11" lat="0.0005" lon="0.0005"/><node id="12" lat="0.0005" lon="0.0007"/>
<node id="13" lat="0.0007" lon="0.0007"/><node id="14" lat="0.0007" lon="0.0005"/>
<node id="15" lat="-0.0005" lon="0.0005"/><node id="16" lat="-0.0005" lon="0.0007"/>
<node id="17" lat="-0.0007" lon="0.0007"/>
<node id="20" lat="0" lon="-0.001"><tag k="highway" v="crossing"/><tag k="tactile_paving" v="yes"/></node>
<node id="21" lat="0.00002" lon="-0.0012"><tag k="highway" v="bus_stop"/><tag k="name" v="High Street"/></node>
<node id="22" lat="0.0006" lon="0.0005"><tag k="entrance" v="main"/></node>
<node id="23" lat="0.001" lon="-0.001"><tag k="railway" v="station"/><tag k="name" v="Central"/></node>
<node id="24" lat="0.0011" lon="-0.001"><tag k="public_transport" v="station"/><tag k="name" v="Central"/></node>
<node id="25" lat="0.001" lon="-0.0005"><tag k="railway" v="station"/><tag k="disused" v="yes"/></node>
<way id="100"><nd ref="1"/><nd ref="20"/><nd ref="2"/><tag k="highway" v="secondary"/><tag k="name" v="High Street"/></way>
<way id="101"><nd ref="2"/><nd ref="3"/><nd ref="4"/><tag k="highway" v="secondary"/><tag k="junction" v="roundabout"/><tag k="name" v="Clock Circle"/></way>
<way id="102"><nd ref="4"/><nd ref="5"/><nd ref="2"/><tag k="highway" v="secondary"/><tag k="junction" v="roundabout"/><tag k="name" v="Clock Circle"/></way>
<way id="103"><nd ref="4"/><nd ref="6"/><tag k="highway" v="secondary"/><tag k="name" v="High Street"/></way>
<way id="104"><nd ref="11"/><nd ref="12"/><nd ref="13"/><nd ref="14"/><nd ref="11"/><tag k="building" v="church"/><tag k="amenity" v="place_of_worship"/><tag k="name" v="St Mary"/></way>
<way id="105"><nd ref="15"/><nd ref="16"/><nd ref="17"/><nd ref="15"/><tag k="amenity" v="hospital"/></way>
<way id="106"><nd ref="4"/><nd ref="15"/><tag k="highway" v="steps"/></way>
<way id="107"><nd ref="1"/><nd ref="23"/><tag k="highway" v="footway"/><tag k="footway" v="sidewalk"/></way>
</osm>
)";

std::size_t count_of(const StreetMap& map, MapPlace::Kind kind) {
  return static_cast<std::size_t>(std::count_if(map.places.begin(), map.places.end(),
                                                [kind](const MapPlace& p) { return p.kind == kind; }));
}

TEST(MapExtractFile, SpecialPlacesAreReadFromTheirTags) {
  const auto extract = parsed(kPlaces);
  ASSERT_TRUE(extract) << extract.error().sentence();
  ExtractWindow window = window_at(0.0, 0.0, 400.0);
  window.layers = ExtractLayers{};
  const auto made = street_map_of(*extract, window);
  ASSERT_TRUE(made) << made.error().sentence();
  const StreetMap& map = made->map;
  ASSERT_EQ(map.places.size(), 4U);
  EXPECT_EQ(map.places[0].kind, MapPlace::Kind::roundabout);
  EXPECT_EQ(map.places[0].name, "Clock Circle");
  EXPECT_NEAR(map.places[0].at.x, 199.5, 0.5);
  EXPECT_NEAR(map.places[0].at.y, 199.5, 0.5);
  EXPECT_EQ(count_of(map, MapPlace::Kind::station), 1U) << "two of one name, and a disused one";
  for (const MapPlace& place : map.places) {
    if (place.kind == MapPlace::Kind::church) {
      EXPECT_EQ(place.outline.size(), 4U);
    } else if (place.kind == MapPlace::Kind::hospital) {
      EXPECT_TRUE(place.outline.empty()) << "grounds";
    }
  }
}

TEST(MapExtractFile, LayersAddPlacesAndWaysForPeopleOnFoot) {
  const auto extract = parsed(kPlaces);
  ASSERT_TRUE(extract);
  ExtractWindow window = window_at(0.0, 0.0, 400.0);
  const auto of_kind = [&](MapStreet::Kind kind) {
    const auto made = street_map_of(*extract, window);
    return std::count_if(made->map.streets.begin(), made->map.streets.end(),
                         [kind](const MapStreet& s) { return s.kind == kind; });
  };
  window.layers = ExtractLayers{};
  EXPECT_EQ(of_kind(MapStreet::Kind::steps), 0);
  EXPECT_EQ(of_kind(MapStreet::Kind::sidewalk), 0);
  window.layers = ExtractLayers{true, true, true, true, true};
  EXPECT_EQ(of_kind(MapStreet::Kind::steps), 1);
  EXPECT_EQ(of_kind(MapStreet::Kind::sidewalk), 1);
  const auto all = street_map_of(*extract, window);
  EXPECT_EQ(count_of(all->map, MapPlace::Kind::crossing), 1U);
  EXPECT_EQ(count_of(all->map, MapPlace::Kind::bus_stop), 1U);
  EXPECT_EQ(count_of(all->map, MapPlace::Kind::entrance), 1U);
  for (const MapPlace& place : all->map.places)
    EXPECT_EQ(place.tactile_paving, place.kind == MapPlace::Kind::crossing);
}

TEST(MapExtractFile, TheUsualLayersDependOnTheWidth) {
  EXPECT_TRUE(usual_layers(300.0).crossings);
  EXPECT_TRUE(usual_layers(600.0).stops);
  EXPECT_FALSE(usual_layers(600.0).steps);
  EXPECT_FALSE(usual_layers(2000.0).stops);
}

}  // namespace
}  // namespace palpable::sources
