// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/frame_order.hpp"
#include "palpable/session/touch/live_source.hpp"
#include "palpable/sources/live/test_ros_messages.hpp"
#include "palpable/sources/live/test_rosbridge_server.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <chrono>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using sources::ros_picture;
using sources::ros_published;

class RosSourceTest : public testing::Test {
 protected:
  /// The next frame, or error, within ten seconds.
  Result<std::optional<LiveFrame>> next() {
    return (*source_)->take(std::chrono::steady_clock::now() + std::chrono::seconds(10));
  }
  void send_depth(float depth_m) {
    server_.send(ros_published("/d", ros_picture<float>(2, 1, "32FC1", 4, {depth_m, 2.0F})));
  }
  /// Taken at this second.
  void send_depth_of(int taken_s, float depth_m) {
    std::string message = ros_published("/d", ros_picture<float>(2, 1, "32FC1", 4, {depth_m, 2.0F}));
    const std::string stamp = R"("secs":1,"nsecs":2)";
    message.replace(message.find(stamp), stamp.size(),
                    R"("secs":)" + std::to_string(taken_s) + R"(,"nsecs":500000000)");
    server_.send(message);
  }

  sources::TestRosbridgeServer server_;
  Result<std::unique_ptr<LiveSource>> source_ = open_live_source(
      "ros://127.0.0.1:" + std::to_string(server_.port()) + "?depth=/d&color=/c&info=/i", {}, {});
};

TEST_F(RosSourceTest, GivesDepthWithItsCameraAndColours) {
  ASSERT_TRUE(source_) << source_.error().sentence();
  server_.send(ros_published("/i", R"({"height":1,"width":2,"K":[2,0,0.5,0,2,0,0,0,1]})"));
  server_.send(ros_published("/c", ros_picture<std::uint8_t>(1, 1, "rgb8", 3, {255, 0, 0})));
  send_depth(1.25F);
  const auto frame = next();
  ASSERT_TRUE(frame && *frame);
  EXPECT_FLOAT_EQ((*frame)->depth.depth_m(0, 0), 1.25F);
  ASSERT_TRUE((*frame)->depth.camera);
  EXPECT_EQ((*frame)->depth.camera->fx, 2.0);
  const auto colour = (*source_)->colour();
  ASSERT_TRUE(colour);
  EXPECT_EQ(rgb8(*colour)(0, 0), (Rgb8{255, 0, 0}));
  EXPECT_FALSE((*source_)->has_ended());
}

TEST_F(RosSourceTest, GoesOnAfterAFrameThatCannotBeRead) {
  ASSERT_TRUE(source_);
  server_.send(ros_published("/d", ros_picture<std::uint8_t>(1, 1, "yuv422", 1, {0})));
  const auto damaged = next();
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().code, ErrorCode::invalid_input);
  EXPECT_NE(damaged.error().message.find("yuv422"), std::string::npos);
  send_depth(1.5F);
  const auto frame = next();
  ASSERT_TRUE(frame && *frame);
  EXPECT_EQ((*frame)->number, 1U);
}

TEST_F(RosSourceTest, BeginsAnewAfterAClockThatWasSetBack) {
  ASSERT_TRUE(source_);
  for (const int taken_s : {100, 3}) {
    send_depth_of(taken_s, 1.0F + 0.001F * static_cast<float>(taken_s));
    const auto frame = next();
    ASSERT_TRUE(frame && *frame) << taken_s;
    EXPECT_NEAR((*frame)->depth.depth_m(0, 0), 1.0 + 0.001 * taken_s, 1e-6);
  }
}

/// A stereo camera before the slope of vision::slanted_scene().
class RosPairTest : public testing::Test {
 protected:
  void open(const std::string& more = "") {
    source_ = open_live_source("ros://127.0.0.1:" + std::to_string(server_.port()) +
                                   "?left=/l&right=/r&left-info=/li&right-info=/ri" + more,
                               {}, {});
    ASSERT_TRUE(*source_) << source_->error().sentence();
  }
  Result<std::optional<LiveFrame>> next(double longest_s = 10.0) {
    return (**source_)->take(std::chrono::steady_clock::now() +
                             std::chrono::milliseconds(static_cast<int>(1000 * longest_s)));
  }
  void send_cameras(double right_fourth) {
    for (const auto& [topic, fourth] : {std::pair("/li", 0.0), {"/ri", right_fourth}})
      server_.send(
          ros_published(topic, fmt::format(R"({{"height":96,"width":160,"K":[150,0,79.5,0,150,47.5,0,0,1],)"
                                           R"("P":[200,0,79.5,{},0,200,47.5,0,0,0,1,0]}})",
                                           fourth)));
  }
  void send_picture(const char* topic, const Image& picture, int taken_s) {
    const Raster<Rgb8> colours = rgb8(picture);
    std::vector<std::uint8_t> bytes;
    for (const Rgb8& pixel : colours.values()) bytes.insert(bytes.end(), {pixel.r, pixel.g, pixel.b});
    std::string message = ros_published(topic, ros_picture(picture.width, picture.height, "rgb8", 3, bytes));
    const std::string stamp = R"("secs":1,)";
    message.replace(message.find(stamp), stamp.size(), R"("secs":)" + std::to_string(taken_s) + ",");
    server_.send(message);
  }

  sources::TestRosbridgeServer server_;
  vision::StereoPair pair_ = vision::render(vision::slanted_scene());
  std::optional<Result<std::unique_ptr<LiveSource>>> source_;
};

TEST_F(RosPairTest, GivesTheMetricDepthOfPicturesThatWereTakenAtOneTime) {
  open();
  // Before the cameras are known a pair has no depth.
  send_picture("/l", pair_.left, 5);
  send_picture("/r", pair_.right, 5);
  EXPECT_FALSE(next(0.3).value());
  send_cameras(-20.0);
  // The partner of this one never comes.
  send_picture("/l", pair_.left, 6);
  send_picture("/r", pair_.right, 7);
  send_picture("/l", pair_.left, 7);
  std::optional<LiveFrame> frame;
  for (int k = 0; k < 5 && !frame; ++k) frame = next(3.0).value();
  ASSERT_TRUE(frame);
  EXPECT_NEAR(*frame->stamp_s, 7.0, 0.1);
  // P: 200 px * 0.1 m / 14 px in the middle of the box.
  EXPECT_NEAR(frame->depth.depth_m(90, 50), 20.0 / 14.0, 0.03);
  ASSERT_TRUE((**source_)->colour());
}

TEST_F(RosPairTest, SaysThatNoDistanceBetweenTheCamerasIsStated) {
  open();
  send_cameras(0.0);
  send_picture("/l", pair_.left, 5);
  send_picture("/r", pair_.right, 5);
  const auto none = next();
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("baseline=METRES"), std::string::npos);
}

TEST(FrameOrder, LeavesOutWhatComesAfterANewerOne) {
  FrameOrder order;
  EXPECT_FALSE(order.is_late(10.0));
  EXPECT_FALSE(order.is_late(10.2));
  EXPECT_TRUE(order.is_late(10.1));
  EXPECT_FALSE(order.is_late(10.2));
  EXPECT_FALSE(order.is_late({}));
  // A clock that was set back.
  EXPECT_FALSE(order.is_late(4.0));
  EXPECT_TRUE(order.is_late(3.9));
}

}  // namespace
}  // namespace palpable::session
