// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/rosbridge_message.hpp"

#include "palpable/sources/live/rosbridge_picture.hpp"
#include "palpable/sources/live/test_ros_messages.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace palpable::sources {
namespace {

RosMessage message_of(const std::string& message) {
  auto heard = parse_rosbridge(ros_published("/t", message));
  EXPECT_TRUE(heard) << (heard ? "" : heard.error().message);
  return heard ? std::get<RosMessage>(*heard) : RosMessage{};
}

std::string refusal_of(const std::string& text) {
  const auto heard = parse_rosbridge(text);
  return heard ? "taken" : heard.error().message;
}

/// Depth of 2 x 1 pixels.
std::pair<float, float> depths_of(const RosBody& body, std::optional<double> scale = {}) {
  const auto depth = depth_of(body, Pinhole{2.0, 2.0, 0.5, 0.0, 2, 1}, scale);
  EXPECT_TRUE(depth) << (depth ? "" : depth.error().message);
  if (!depth) return {};
  return {depth->depth_m(0, 0), depth->depth_m(1, 0)};
}

TEST(RosbridgePicture, IsDepthInMillimetresOrMetres) {
  const auto whole = message_of(ros_picture<std::uint16_t>(2, 1, "16UC1", 2, {1500, 0}));
  EXPECT_EQ(whole.topic, "/t");
  EXPECT_EQ(whole.version, RosVersion::ros1);
  EXPECT_FLOAT_EQ(depths_of(whole.body).first, 1.5F);
  EXPECT_TRUE(std::isnan(depths_of(whole.body).second));
  EXPECT_FLOAT_EQ(depths_of(whole.body, 0.0001).first, 0.15F);
  const auto real = message_of(ros_picture<float>(2, 1, "32FC1", 4, {1.5F, -2.0F}));
  EXPECT_FLOAT_EQ(depths_of(real.body).first, 1.5F);
  EXPECT_TRUE(std::isnan(depths_of(real.body).second));
}

TEST(RosbridgePicture, IsReadInTheOrderOfItsBytesAndWithItsRowsApart) {
  const auto message = message_of(
      R"({"header":{"stamp":{"sec":1,"nanosec":2}},"height":1,"width":2,"encoding":"16UC1","is_bigendian":1,)"
      R"("step":6,"data":[5,220,0,1,255,255]})");
  EXPECT_EQ(message.version, RosVersion::ros2);
  EXPECT_FLOAT_EQ(depths_of(message.body).first, 1.5F);
  EXPECT_FLOAT_EQ(depths_of(message.body).second, 0.001F);
}

TEST(RosbridgePicture, HasItsColoursInTheOrderOfItsEncoding) {
  const auto first = [](const std::string& encoding, std::vector<std::uint8_t> pixel) {
    const auto message = message_of(ros_picture(1, 1, encoding, pixel.size(), pixel));
    const auto image = colour_of(message.body);
    EXPECT_TRUE(image);
    return rgb8(*image)(0, 0);
  };
  const Rgb8 expected{255, 51, 0};
  EXPECT_EQ(first("rgb8", {255, 51, 0}), expected);
  EXPECT_EQ(first("bgr8", {0, 51, 255}), expected);
  EXPECT_EQ(first("bgra8", {0, 51, 255, 9}), expected);
  EXPECT_EQ(first("mono8", {51}), (Rgb8{51, 51, 51}));
}

std::string compressed(const std::string& format, const std::vector<std::uint8_t>& bytes) {
  return fmt::format(R"({{"header":{{}},"format":"{}","data":"{}"}})", format, ros_base64(bytes));
}

TEST(RosbridgePicture, IsUnpacked) {
  const cv::Mat depth_mm = (cv::Mat_<std::uint16_t>(1, 2) << 1500, 0);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", depth_mm, png);
  EXPECT_FLOAT_EQ(depths_of(message_of(compressed("16UC1; png compressed", png)).body).first, 1.5F);
  // The parameters 3 and 1 of inverse depth: 1500 is 3 / 1499 m.
  std::vector<std::uint8_t> with_header{0, 0, 0, 0, 0, 0, 0x40, 0x40, 0, 0, 0x80, 0x3F};
  with_header.insert(with_header.end(), png.begin(), png.end());
  EXPECT_FLOAT_EQ(depths_of(message_of(compressed("16UC1; compressedDepth png", with_header)).body).first,
                  1.5F);
  EXPECT_FLOAT_EQ(depths_of(message_of(compressed("32FC1; compressedDepth png", with_header)).body).first,
                  3.0F / 1499.0F);
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", cv::Mat(8, 8, CV_8UC3, cv::Scalar(0, 0, 255)), jpeg);
  const auto red = colour_of(message_of(compressed("bgr8; jpeg compressed bgr8", jpeg)).body);
  ASSERT_TRUE(red);
  EXPECT_GT(rgb8(*red)(4, 4).r, 250);
}

std::string cloud(std::size_t z_datatype) {
  const std::vector<float> points{-0.5F, 0.0F, 2.0F, 0.5F, 0.0F, 3.0F, 0.4F, 0.0F, 2.0F, NAN, 0.0F, 1.0F};
  return fmt::format(
      R"({{"header":{{}},"height":1,"width":4,"point_step":12,"row_step":48,"is_bigendian":false,"fields":[)"
      R"({{"name":"x","offset":0,"datatype":7,"count":1}},{{"name":"y","offset":4,"datatype":7,"count":1}},)"
      R"({{"name":"z","offset":8,"datatype":{},"count":1}}],"data":"{}"}})",
      z_datatype, ros_base64(points));
}

TEST(RosbridgePicture, OfACloudShowsTheNearestPointOfEachPixel) {
  const auto depths = depths_of(message_of(cloud(7)).body);
  EXPECT_FLOAT_EQ(depths.first, 2.0F);
  EXPECT_FLOAT_EQ(depths.second, 2.0F);
  EXPECT_NE(refusal_of(ros_published("/t", cloud(8))).find("without points of float32"), std::string::npos);
  EXPECT_FALSE(depth_of(message_of(cloud(7)).body, std::nullopt, std::nullopt));
}

TEST(RosbridgeMessage, HasACameraOfBothVersions) {
  for (const auto* name : {"K", "k"}) {
    const auto message = message_of(
        fmt::format(R"({{"height":480,"width":640,"{}":[525.0,0,319.5,0,526,239.5,0,0,1]}})", name));
    const auto& camera = std::get<RosCamera>(message.body);
    EXPECT_EQ(camera.camera, (Pinhole{525.0, 526.0, 319.5, 239.5, 640, 480}));
    EXPECT_FALSE(camera.rectified);
  }
}

TEST(RosbridgeMessage, HasTheCamerasOfARectifiedPair) {
  for (const auto* name : {"P", "p"}) {
    const auto camera = [&](const char* projection) {
      return std::get<RosCamera>(
          message_of(
              fmt::format(R"({{"height":480,"width":640,"k":[525,0,319.5,0,526,239.5,0,0,1],"{}":{}}})", name,
                          projection))
              .body);
    };
    const auto right = camera("[500,0,310,-60,0,501,240,0,0,0,1,0]");
    ASSERT_TRUE(right.rectified);
    EXPECT_EQ(*right.rectified, (Pinhole{500.0, 501.0, 310.0, 240.0, 640, 480}));
    EXPECT_DOUBLE_EQ(right.right_m, 0.12);
    // A camera that was never calibrated states zeros; others are none.
    for (const auto* none :
         {"[0,0,0,0,0,0,0,0,0,0,0,0]", "[500,0,310]", "7", "[1e-3,0,1,\"x\",0,1,1,0,0,0,1,0,2]"})
      EXPECT_FALSE(camera(none).rectified) << none;
    EXPECT_EQ(camera("[1,0,1,-1e9,0,1,1,0,0,0,1,0]").right_m, 0.0);
  }
}

TEST(RosbridgeMessage, HasOdometryAndABattery) {
  const auto message = message_of(
      R"({"pose":{"pose":{"position":{"x":1,"y":-2,"z":0},"orientation":{"x":0,"y":0,"z":1,"w":0}}},)"
      R"("twist":{"twist":{"linear":{"x":0.25},"angular":{"z":-0.5}}}})");
  const auto& odometry = std::get<RosOdometry>(message.body);
  EXPECT_DOUBLE_EQ(odometry.y_m, -2.0);
  EXPECT_NEAR(odometry.yaw_rad, M_PI, 1e-12);
  EXPECT_DOUBLE_EQ(odometry.turn_rad_per_s, -0.5);
  // Turned by a quarter about y: the child's z axis is the parent's x.
  const auto pose =
      std::get<RosPose>(message_of(R"({"pose":{"position":{"x":1,"y":2,"z":3},)"
                                   R"("orientation":{"x":0,"y":0.70710678,"z":0,"w":0.70710678}}})")
                            .body);
  EXPECT_EQ(pose.position_m, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_NEAR(pose.rotation[2], 1.0, 1e-12);
  EXPECT_NEAR(pose.rotation[6], -1.0, 1e-12);
  EXPECT_TRUE(std::get<RosFlag>(message_of(R"({"data":true})").body).value);
  EXPECT_FALSE(message.stamp_s);
  EXPECT_DOUBLE_EQ(*message_of(R"({"header":{"stamp":{"sec":5,"nanosec":500000000}},"data":true})").stamp_s,
                   5.5);
  EXPECT_DOUBLE_EQ(std::get<RosBattery>(message_of(R"({"voltage":11,"percentage":0.5})").body).charge, 0.5);
}

TEST(RosbridgeMessage, IsRefusedInOneClauseIfItIsNone) {
  const auto picture = [](const char* width, const char* step, const char* data) {
    return ros_published(
        "/t", fmt::format(R"({{"height":1,"width":{},"encoding":"16UC1","step":{},"data":{}}})", width, step,
                          data));
  };
  const std::string flat = R"([0,0])";
  const std::pair<std::string, std::string> kCases[] = {
      {"", "something else than JSON"},
      {R"({"op":"publish","topic":"/t","msg":{"percentage":NaN}})", "something else than JSON"},
      {std::string(100'000, '['), "nested deeper"},
      {R"({"a":[)" + std::string(3'000'001, ','), "nested deeper"},
      {R"({"op":"fragment"})", "was not asked for"},
      {R"({"op":"publish","topic":7,"msg":{}})", "was not asked for"},
      {ros_published("/t", R"({"data":"hello"})"), "damaged sound"},
      {ros_published("/t", R"({"data":7})"), "another type"},
      {picture("1", "2", R"("%%%%")"), "damaged"},
      {picture("1", "2", R"([0,256])"), "damaged"},
      {picture("-1", "2", flat.c_str()), "without a size"},
      {picture("1e9", "2", flat.c_str()), "without a size"},
      {picture("1000000000", "2", flat.c_str()), "without a size"},
      {picture("0", "2", flat.c_str()), "a picture that"},
      {picture("1", "3", flat.c_str()), "less of a picture"},
      {ros_published("/t", R"({"height":1,"width":1,"K":[0,0,0,0,0,0,0,0,1]})"), "a camera that is none"},
      {ros_published("/t", R"({"pose":1,"twist":{}})"), "odometry that is none"},
      {ros_published("/t", R"({"pose":{"position":{"x":1,"y":2},"orientation":{"x":0,"y":0,"z":0,"w":1}}})"),
       "a pose that is none"},
      {ros_published("/t",
                     R"({"pose":{"pose":{"position":{"x":1,"y":2},"orientation":{"x":0,"y":0,"z":0,"w":0}}},)"
                     R"("twist":{"twist":{"linear":{"x":0},"angular":{"z":0}}}})"),
       "no unit quaternion"}};
  for (const auto& [text, part] : kCases)
    EXPECT_NE(refusal_of(text).find(part), std::string::npos)
        << text.substr(0, 80) << ": " << refusal_of(text);
}

TEST(RosbridgePicture, IsRefusedIfItsEncodingNeedsMoreOrIsUnknown) {
  const auto wide = message_of(ros_picture<std::uint8_t>(3, 1, "16UC1", 1, {0, 0, 0}));
  EXPECT_FALSE(depth_of(wide.body, {}, {}));
  EXPECT_FALSE(colour_of(message_of(ros_picture<std::uint8_t>(1, 1, "rgb8", 1, {0})).body));
  EXPECT_FALSE(colour_of(message_of(ros_picture<std::uint8_t>(1, 1, "yuv422", 1, {0})).body));
  EXPECT_FALSE(depth_of(message_of(compressed("16UC1; compressedDepth", {1, 2, 3})).body, {}, {}));
  const auto far = depth_of(message_of(ros_picture<float>(1, 1, "32FC1", 4, {1500.0F})).body, {}, {});
  ASSERT_FALSE(far);
  EXPECT_NE(far.error().message.find("millimetres"), std::string::npos);
}

TEST(RosbridgeMessage, StatesErrorsOfItsServerInOneShortLine) {
  const auto heard = parse_rosbridge(R"({"op":"status","level":"error","msg":"a\nb\u001b )" +
                                     std::string(500, 'x') + R"("})");
  ASSERT_TRUE(heard);
  const auto& status = std::get<RosStatus>(*heard);
  EXPECT_TRUE(status.is_error);
  EXPECT_TRUE(status.words.starts_with("a b "));
  EXPECT_EQ(status.words.find('\x1b'), std::string::npos);
  EXPECT_EQ(status.words.size(), 200U);
}

TEST(RosbridgeMessage, ReadsSoundAndItsFormat) {
  const auto of = [](const char* message) {
    return parse_rosbridge(std::string(R"({"op":"publish","topic":"/audio","msg":)") + message + "}");
  };
  for (const char* message :
       {R"({"data":"AQIDBA=="})", R"({"data":[1,2,3,4]})", R"({"header":{},"audio":{"data":"AQIDBA=="}})"}) {
    const auto heard = of(message);
    ASSERT_TRUE(heard) << message;
    const auto* sound = std::get_if<RosSound>(&std::get<RosMessage>(*heard).body);
    ASSERT_NE(sound, nullptr) << message;
    EXPECT_EQ(sound->data.size(), 4U);
    EXPECT_EQ(sound->data[3], std::byte{4});
  }
  const auto format =
      of(R"({"channels":4,"sample_rate":16000,"sample_format":"S16LE","bitrate":0,"coding_format":"wave"})");
  ASSERT_TRUE(format);
  const auto* stated = std::get_if<RosSoundFormat>(&std::get<RosMessage>(*format).body);
  ASSERT_NE(stated, nullptr);
  EXPECT_EQ(stated->channels, 4);
  EXPECT_EQ(stated->rate_hz, 16'000);
  EXPECT_EQ(stated->samples, "S16LE");
  for (const char* wrong :
       {R"({"data":"*"})", R"({"data":[1,256]})", R"({"audio":{"data":3}})",
        R"({"channels":0,"sample_rate":16000,"sample_format":"S16LE"})",
        R"({"channels":4,"sample_rate":1,"sample_format":"S16LE"})", R"({"channels":4,"sample_rate":16000})"})
    EXPECT_FALSE(of(wrong)) << wrong;
}

}  // namespace
}  // namespace palpable::sources
