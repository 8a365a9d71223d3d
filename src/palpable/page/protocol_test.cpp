// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/protocol.hpp"

#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palpable::page::protocol {
namespace {

using Json = nlohmann::json;

TEST(PageProtocol, ParsesEveryMessageOfThePage) {
  const auto pointer =
      parse_from_page(R"({"type":"pointer","probe":3,"x_m":0.01,"y_m":-0.02,"press_m":0.002})");
  ASSERT_TRUE(pointer);
  EXPECT_EQ(std::get<Pointer>(*pointer), (Pointer{3, 0.01, -0.02, 0.002}));
  const auto change = parse_from_page(
      R"({"type":"change","serial":4294967295,"law":"proxy","parameters":[{"name":"static_friction","value":0.3}],"height_factor":1})");
  ASSERT_TRUE(change);
  EXPECT_EQ(std::get<Change>(*change), (Change{4294967295, "proxy", {{"static_friction", 0.3}}, 1}));
  const auto edit = parse_from_page(
      R"({"type":"edit","serial":1,"label":2,"material":{"stiffness_N_per_m":300,"damping_Ns_per_m":null,"friction":0,"stickiness":null,"texture":{"kind":"grain","pitch_m":0.002,"height_m":0,"angle_deg":-45}}})");
  ASSERT_TRUE(edit) << edit.error().sentence();
  EXPECT_EQ(std::get<Edit>(*edit), (Edit{1, 2, {300.0, {}, 0.0, {}, Texture{"grain", 0.002, 0, -45}}}))
      << "null is not set; 0 is set";
  EXPECT_TRUE(std::holds_alternative<Save>(*parse_from_page(R"({"type":"save"})")));
  EXPECT_TRUE(std::get<Pause>(*parse_from_page(R"({"type":"pause","paused":true})")).paused);
  EXPECT_TRUE(std::holds_alternative<Recentre>(*parse_from_page(R"({"type":"recentre"})")));
  const auto pose = parse_from_page(R"({"type":"move_explorer","x_m":0.01,"y_m":-0.02,"heading_deg":90})");
  ASSERT_TRUE(pose);
  EXPECT_EQ(std::get<MoveExplorer>(*pose).heading_deg, 90.0);
  EXPECT_FALSE(std::get<Visible>(*parse_from_page(R"({"type":"visible","visible":false})")).visible);
}

TEST(PageProtocol, RefusesInvalidMessagesWithASentence) {
  const std::string deep(100000, '[');
  for (const std::string& junk :
       {std::string(),
        std::string("{"),
        std::string("[]"),
        std::string("null"),
        std::string("7"),
        deep,
        std::string(R"({"type":7})"),
        std::string(R"({"type":"hello"})"),
        std::string(R"({"type":"fly"})"),
        std::string(R"({"x_m":1})"),
        std::string(R"({"type":"pause"})"),
        std::string(R"({"type":"pause","paused":1})"),
        std::string(R"({"type":"pause","paused":true,"more":1})"),
        std::string(R"({"type":"pause","paused":{}})"),
        std::string(R"({"type":"pointer","probe":3,"x_m":1e9,"y_m":0,"press_m":0})"),
        std::string(R"({"type":"pointer","probe":10,"x_m":0,"y_m":0,"press_m":0})"),
        std::string(R"({"type":"pointer","probe":-1,"x_m":0,"y_m":0,"press_m":0})"),
        std::string(R"({"type":"lift","probe":0})"),
        std::string(R"({"type":"pointer","probe":3,"x_m":1e999,"y_m":0,"press_m":0})"),
        std::string(R"({"type":"pointer","probe":3,"x_m":"0","y_m":0,"press_m":0})"),
        std::string(R"({"type":"pointer","probe":3,"x_m":null,"y_m":0,"press_m":0})"),
        std::string("\xff\xfe{}")}) {
    const auto message = parse_from_page(junk);
    ASSERT_FALSE(message) << junk.substr(0, 80);
    EXPECT_EQ(message.error().code, ErrorCode::invalid_input);
    EXPECT_FALSE(message.error().message.empty());
  }
}

TEST(PageProtocol, RefusesALawNameThatIsTooLong) {
  Json change = {{"type", "change"},
                 {"serial", 1},
                 {"law", std::string(33, 'x')},
                 {"parameters", Json::array()},
                 {"height_factor", 1.0}};
  EXPECT_FALSE(parse_from_page(change.dump()));
  change["law"] = std::string(32, 'x');
  EXPECT_TRUE(parse_from_page(change.dump()));
  change["serial"] = 1.5;
  EXPECT_FALSE(parse_from_page(change.dump()));
  change["serial"] = -1;
  EXPECT_FALSE(parse_from_page(change.dump()));
}

TEST(PageProtocol, NamesTheWrongFieldInListsAndObjects) {
  const auto complaint = [](const Json& parameters) {
    const Json change = {
        {"type", "change"}, {"serial", 1}, {"law", "x"}, {"parameters", parameters}, {"height_factor", 1}};
    const auto read = parse_from_page(change.dump());
    return read ? std::string() : read.error().message;
  };
  const Json good = {{"name", "a"}, {"value", 1.0}};
  EXPECT_EQ(complaint(Json::array({good, good})), "");
  EXPECT_EQ(complaint(Json(17, good)), "change: 'parameters' must be a list of at most 16 values");
  EXPECT_EQ(complaint(good), "change: 'parameters' must be a list of at most 16 values");
  EXPECT_EQ(complaint(nullptr), "change: 'parameters' must be a list of at most 16 values");
  EXPECT_EQ(complaint({7}), "change: 'parameters' must be an object");
  EXPECT_EQ(complaint({{{"name", "a"}}}), "change: 'parameters': the field 'value' is missing");
  EXPECT_EQ(complaint({{{"name", "a"}, {"value", nullptr}}}),
            "change: 'parameters': 'value' must be a number within its limits");
  EXPECT_EQ(complaint({{{"name", "a"}, {"value", 1}, {"more", 1}}}),
            "change: 'parameters': there are fields that the message does not have");
  EXPECT_EQ(complaint({{{"name", Json::array({Json::array()})}, {"value", 1}}}),
            "the message is not a JSON object, or too deep");
}

TEST(PageProtocol, WritesUnsetValuesAsNull) {
  Settings settings;
  settings.parameters = {{"stiffness_N_per_m", {}, 500.0}, {"static_friction", 0.0, 0.0}};
  const Json json = Json::parse(write_message(settings));
  EXPECT_TRUE(json["parameters"][0]["set"].is_null());
  EXPECT_EQ(json["parameters"][0]["used"], 500.0);
  EXPECT_EQ(json["parameters"][1]["set"], 0.0);
}

TEST(PageProtocol, ClampsNumbersThatAreNotFiniteOrTooLarge) {
  State state;
  auto& probe = state.probes.emplace_back();
  probe.x_m = std::numeric_limits<double>::quiet_NaN();
  probe.fz_N = std::numeric_limits<double>::infinity();
  probe.fx_N = -1e30;
  const Json message = Json::parse(write_message(state));
  EXPECT_EQ(message["type"], "state");
  const Json& json = message["probes"][0];
  EXPECT_EQ(json["x_m"], 0.0);
  EXPECT_EQ(json["fz_N"], 0.0);
  EXPECT_EQ(json["fx_N"], -1000.0);
}

TEST(PageProtocol, TruncatesTextAtACharacterBoundary) {
  Laws laws;
  laws.laws.emplace_back().name = std::string(31, 'a') + "\xc3\xa4";  // 33 bytes, the last two are one letter
  EXPECT_EQ(Json::parse(write_message(laws))["laws"][0]["name"], std::string(31, 'a'));
  laws.laws[0].name = "\xff";
  EXPECT_EQ(Json::parse(write_message(laws))["laws"][0]["name"], "\xef\xbf\xbd");
}

TEST(PageProtocol, WritesARasterThatMatchesItsHeader) {
  Raster<float> heights(3, 2);
  heights(2, 1) = 1.5F;
  const std::string frame = write_floats(RasterKind::heights, 7, heights);
  ASSERT_EQ(frame.size(), 20U + 24U);
  std::uint32_t words[5];
  std::memcpy(words, frame.data(), sizeof words);
  EXPECT_EQ(frame.substr(0, 4), "PLP1");
  EXPECT_EQ(words[1], 1U);
  EXPECT_EQ(words[2], 7U);
  EXPECT_EQ(words[3], 3U);
  EXPECT_EQ(words[4], 2U);
  float last = 0.0F;
  std::memcpy(&last, frame.data() + 40, 4);
  EXPECT_EQ(last, 1.5F);
}

TEST(PageProtocol, ReducesRastersByBlockMeans) {
  Raster<float> ramp(1000, 500);
  for (int y = 0; y < 500; ++y)
    for (int x = 0; x < 1000; ++x) ramp(x, y) = static_cast<float>(x);
  const auto thin = thinned(ramp, 100);
  ASSERT_EQ(thin.width(), 100);
  ASSERT_EQ(thin.height(), 50);
  EXPECT_FLOAT_EQ(thin(0, 0), 4.5F);
  EXPECT_FLOAT_EQ(thin(99, 49), 994.5F);
  EXPECT_EQ(thinned(thin, 100), thin);
  EXPECT_EQ(thinned(Raster<float>(3000, 2), 300).height(), 2);
  EXPECT_TRUE(thinned(Raster<float>(), 300).empty());
  const Raster<Rgb8> grey(400, 400, Rgb8{10, 20, 30});
  EXPECT_EQ(thinned(grey, 33)(32, 32), (Rgb8{10, 20, 30}));
}

}  // namespace
}  // namespace palpable::page::protocol
