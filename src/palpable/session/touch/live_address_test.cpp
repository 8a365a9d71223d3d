// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_address.hpp"

#include <string>
#include <utility>
#include <variant>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

TEST(LiveAddress, ReadsTheAddressOfACamera) {
  const auto parsed = parse_live_address("http://camera.local:8081/video?size=1#right=http://[::1]/b?c&d=e");
  ASSERT_TRUE(parsed) << parsed.error().sentence();
  const auto& cameras = std::get<HttpCameras>(*parsed);
  EXPECT_EQ(cameras.left.host, "camera.local");
  EXPECT_EQ(cameras.left.port, "8081");
  EXPECT_EQ(cameras.left.authority, "camera.local:8081");
  EXPECT_EQ(cameras.left.target, "/video?size=1");
  EXPECT_EQ(cameras.left.shown, "http://camera.local:8081/video?size=1");
  ASSERT_TRUE(cameras.right);
  EXPECT_EQ(cameras.right->host, "::1");
  EXPECT_EQ(cameras.right->port, "80");
  EXPECT_EQ(cameras.right->target, "/b?c&d=e");
  for (const char* short_one : {"http://host", "http://host?x"})
    EXPECT_TRUE(parse_live_address(short_one)) << short_one;
  EXPECT_EQ(std::get<HttpCameras>(*parse_live_address("http://host?x")).left.target, "/?x");
}

TEST(LiveAddress, ReadsNetworkStreams) {
  const auto parsed = parse_live_address("rtsp://me:p@ss@cam.local:554/s?x=1#right=rtsp://[::1]/b&c");
  ASSERT_TRUE(parsed) << parsed.error().sentence();
  const auto& cameras = std::get<StreamCameras>(*parsed);
  EXPECT_EQ(cameras.left.url, "rtsp://me:p@ss@cam.local:554/s?x=1");
  EXPECT_EQ(cameras.left.shown, "rtsp://cam.local:554/s?x=1");
  ASSERT_TRUE(cameras.right);
  EXPECT_EQ(cameras.right->url, "rtsp://[::1]/b&c");
  EXPECT_FALSE(cameras.left.takes_any_certificate);
  const auto any =
      std::get<StreamCameras>(*parse_live_address("https://a/#certificate=any&right=https://b/"));
  EXPECT_TRUE(any.left.takes_any_certificate && any.right->takes_any_certificate);
  EXPECT_TRUE(
      std::get<StreamCameras>(*parse_live_address("rtsps://a/b#certificate=any")).left.takes_any_certificate);
  // A sentence about a wrong address does not repeat its password.
  for (const char* wrong :
       {"rtsp://", "rtsp:host", "rtsp://me:secret@/x", "rtsp://me:secret@a/b c",
        "rtsp://me:secret@a/#certificate=any", "https://me:secret@a/#right=http://b/",
        "https://me:secret@a/#certificate=none", "rtsp://a/#right=rtsp://me:secret@b/#x"}) {
    const auto refused = parse_live_address(wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.error().code, ErrorCode::usage) << wrong;
    EXPECT_EQ(refused.error().sentence().find("secret"), std::string::npos) << refused.error().sentence();
  }
}

TEST(LiveAddress, ReadsCamerasOfThisMachine) {
  const auto parsed = parse_live_address("camera:1?right=3&size=640x480&fps=15&format=yuyv");
  ASSERT_TRUE(parsed) << parsed.error().sentence();
  const auto& cameras = std::get<VideoCameras>(*parsed);
  EXPECT_EQ(cameras.left.number, 1);
  EXPECT_EQ(cameras.left.width, 640);
  EXPECT_EQ(cameras.left.height, 480);
  EXPECT_EQ(cameras.left.rate_hz, 15);
  EXPECT_EQ(cameras.left.coding, sources::CameraCoding::yuyv);
  ASSERT_TRUE(cameras.right);
  EXPECT_EQ(cameras.right->number, 3);
  EXPECT_EQ(cameras.right->width, 640);
  // Opening it lists the cameras that there are.
  EXPECT_EQ(std::get<VideoCameras>(*parse_live_address("camera:")).left.number, -1);
  const auto plain = std::get<VideoCameras>(*parse_live_address("camera:0"));
  EXPECT_FALSE(plain.right || plain.left.coding || plain.left.width != 0 || plain.left.rate_hz != 0);
}

TEST(LiveAddress, ReadsDepthCamerasOfThisMachine) {
  using Kind = sources::DepthCamera::Kind;
  for (const auto& [scheme, kind] : {std::pair("openni", Kind::openni), std::pair("freenect", Kind::freenect),
                                     std::pair("realsense", Kind::realsense)}) {
    const auto parsed = parse_live_address(std::string(scheme) + ":2?library=/opt/lib.so");
    ASSERT_TRUE(parsed) << parsed.error().sentence();
    const auto& camera = std::get<sources::DepthCamera>(*parsed);
    EXPECT_EQ(camera.kind, kind);
    EXPECT_EQ(camera.number, 2);
    EXPECT_EQ(camera.library, "/opt/lib.so");
    // The first, where the system looks.
    const auto plain = std::get<sources::DepthCamera>(*parse_live_address(std::string(scheme) + ":"));
    EXPECT_EQ(plain.number, 0);
    EXPECT_EQ(plain.library, "");
    for (const char* wrong : {":x", ":-1", ":64", ":0?lib=x"})
      EXPECT_FALSE(parse_live_address(scheme + std::string(wrong))) << scheme << wrong;
  }
}

TEST(LiveAddress, ReadsTheTopicsOfARosbridgeServer) {
  const auto parsed =
      parse_live_address("ros://robot.local:9091?depth=/cam_1/depth&info=/cam_1/info&scale=0.001");
  ASSERT_TRUE(parsed) << parsed.error().sentence();
  const auto& ros = std::get<RosAddress>(*parsed);
  EXPECT_EQ(ros.host, "robot.local");
  EXPECT_EQ(ros.port, "9091");
  EXPECT_EQ(ros.depth, "/cam_1/depth");
  EXPECT_EQ(ros.colour, "/camera/color/image_raw/compressed");
  EXPECT_EQ(ros.info, "/cam_1/info");
  EXPECT_EQ(ros.metres_per_unit, 0.001);
  EXPECT_EQ(std::get<RosAddress>(*parse_live_address("ros://[::1]")).port, "9090");
  for (const char* wrong :
       {"ros:robot", "ros://", "ros://a:0", "ros://me@a", "ros://a/b", "ros://a?depth=depth",
        "ros://a?depth=/a//b", "ros://a?color=/a b", "ros://a?scale=0", "ros://a?topic=/a"})
    EXPECT_EQ(parse_live_address(wrong).error().code, ErrorCode::usage) << wrong;
}

TEST(LiveAddress, ReadsAStereoCameraOfARosbridgeServer) {
  const auto parsed = parse_live_address(
      "robot:turtle?left=/s/l/image&right=/s/r/image&right-info=/s/r/info&camera-left=0.06");
  ASSERT_TRUE(parsed) << parsed.error().sentence();
  const auto& robot = std::get<RobotAddress>(*parsed);
  ASSERT_TRUE(robot.pictures.pair);
  EXPECT_EQ(robot.pictures.pair->left, "/s/l/image");
  EXPECT_EQ(robot.pictures.pair->right, "/s/r/image");
  EXPECT_EQ(robot.pictures.pair->left_info, "/stereo/left/camera_info");
  EXPECT_EQ(robot.pictures.pair->right_info, "/s/r/info");
  EXPECT_FALSE(robot.pictures.pair->baseline_m);
  EXPECT_EQ(robot.drive.shape.camera_left_m, 0.06);
  const auto stated = parse_live_address("ros://a?left=/l&right=/r&baseline=0.1");
  ASSERT_TRUE(stated) << stated.error().sentence();
  EXPECT_EQ(std::get<RosAddress>(*stated).pair->baseline_m, 0.1);
  EXPECT_FALSE(std::get<RosAddress>(*parse_live_address("ros://a")).pair);
  for (const char* wrong :
       {"ros://a?left=/l", "ros://a?right=/r", "ros://a?left=/l&right=/l",
        "ros://a?left=/l&right=/r&depth=/d", "ros://a?left=/l&right=/r&baseline=0", "ros://a?baseline=0.1"})
    EXPECT_EQ(parse_live_address(wrong).error().code, ErrorCode::usage) << wrong;
}

TEST(LiveAddress, ReadsARobotAndItsCamera) {
  const auto parsed =
      parse_live_address("robot:turtle:9091?cmd=/base/cmd&depth=/d&radius=0.2&camera-down=30&mode=look");
  ASSERT_TRUE(parsed) << parsed.error().sentence();
  const auto& robot = std::get<RobotAddress>(*parsed);
  EXPECT_EQ(robot.pictures.host, "turtle");
  EXPECT_EQ(robot.pictures.depth, "/d");
  EXPECT_EQ(robot.command, "/base/cmd");
  EXPECT_EQ(robot.odometry, "/odom");
  EXPECT_EQ(robot.drive.shape.radius_m, 0.2);
  EXPECT_NEAR(robot.drive.shape.camera_down_rad, 0.5236, 1e-4);
  EXPECT_EQ(robot.mode, RobotMode::look);
  EXPECT_FALSE(robot.wrist || robot.pulls_to_sounds);
  const auto armed =
      parse_live_address("robot:turtle?arm=/servo/cmd&wrist=/hand/rgb&sweep=0.02&sound-pull=1");
  ASSERT_TRUE(armed) << armed.error().sentence();
  const auto& wrist = std::get<RobotAddress>(*armed).wrist;
  ASSERT_TRUE(wrist);
  EXPECT_EQ(wrist->arm, "/servo/cmd");
  EXPECT_EQ(wrist->picture, "/hand/rgb");
  EXPECT_EQ(wrist->sweep.half_m, 0.02);
  EXPECT_TRUE(std::get<RobotAddress>(*armed).pulls_to_sounds);
  for (const char* wrong : {"robot:", "robot:a?radius=9", "robot:a?mode=fly", "robot:a?cmd=cmd", "robot:a:x",
                            "robot:a?arm=/a&sweep=0.2", "robot:a?sound-pull=2"})
    EXPECT_EQ(parse_live_address(wrong).error().code, ErrorCode::usage) << wrong;
}

TEST(LiveAddress, RefusesWhatIsNone) {
  for (const char* wrong : {"http://",
                            "http:host",
                            "http:///path",
                            "http://:80/",
                            "http://a:0/",
                            "http://a:65536/",
                            "http://a:b/",
                            "http://[::1/",
                            "http://[::1]x/",
                            "http://me:secret@a/",
                            "http://a/b c",
                            "http://a/\r\nX: y",
                            "http://a/\xC3\xA4",
                            "http://a/#left=1",
                            "http://a/#right=file:///etc/passwd",
                            "http://a/#right=http://b/#right=http://c@d/",
                            "camera:64",
                            "camera:x",
                            "camera:0?right=0",
                            "camera:0?right=64",
                            "camera:0?size=640",
                            "camera:0?size=0x1",
                            "camera:0?size=1x1x",
                            "camera:0?fps=0",
                            "camera:0?format=h264",
                            "camera:0?loop=1",
                            "robot:sample"}) {
    const auto parsed = parse_live_address(wrong);
    ASSERT_FALSE(parsed) << wrong;
    EXPECT_EQ(parsed.error().code, ErrorCode::usage) << wrong;
  }
}

}  // namespace
}  // namespace palpable::session
