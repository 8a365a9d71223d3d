// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_address.hpp"
#include "palpable/session/touch/live_source.hpp"
#include "palpable/session/touch/test_mjpeg_server.hpp"
#include "palpable/sources/live/http_camera.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <variant>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

sources::HttpAddress address_of(const std::string& url) {
  return std::get<HttpCameras>(*parse_live_address(url)).left;
}

/// The next frame of a source, or its error, within twenty seconds.
Result<std::optional<LiveFrame>> frame_of(LiveSource& source) {
  const auto end = Clock::now() + std::chrono::seconds(20);
  auto frame = source.take(end);
  while (frame && !*frame && Clock::now() < end) frame = source.take(end);
  return frame;
}

TEST(HttpCamera, GivesTheDepthOfAPairInOnePicture) {
  const MjpegServer server(moving_pairs(1));
  const auto source = open_live_source(server.url(), {}, {});
  ASSERT_TRUE(source) << source.error().sentence();
  const auto frame = frame_of(**source);
  ASSERT_TRUE(frame && *frame) << frame.error().sentence();
  const auto& depth_m = (*frame)->depth.depth_m;
  EXPECT_EQ(depth_m.width(), 160);
  auto truth = vision::slanted_scene();
  truth.box_px = 10.0;
  EXPECT_NEAR(depth_m(130, 20) / depth_m(90, 50), truth.truth(90, 50) / truth.truth(130, 20), 0.05);
  EXPECT_EQ((*source)->kind(), "stereo camera");
}

TEST(HttpCamera, TakesLayoutAndASecondCamera) {
  const MjpegServer server(moving_pairs(1));
  LivePairOptions options;
  options.layout = sources::StereoLayout::over_under;
  const auto low = open_live_source(server.url(), options, {});
  ASSERT_TRUE(low);
  const auto half = frame_of(**low);
  ASSERT_TRUE(half && *half) << half.error().sentence();
  EXPECT_EQ((*half)->depth.depth_m.width(), 320);
  const MjpegServer left(moving_pairs(1));
  const MjpegServer right(moving_pairs(1));
  const auto two = open_live_source(left.url() + "#right=" + right.url(), {}, {});
  ASSERT_TRUE(two) << two.error().sentence();
  const auto whole = frame_of(**two);
  ASSERT_TRUE(whole && *whole) << whole.error().sentence();
  EXPECT_EQ((*whole)->depth.depth_m.width(), 320);
  EXPECT_EQ((*whole)->depth.depth_m.height(), 96);
}

TEST(HttpCamera, LosesACameraThatFallsSilentOrEnds) {
  std::optional<MjpegServer> server(std::in_place, moving_pairs(1));
  const auto lost_of = [](sources::CameraLink& link) {
    const auto end = Clock::now() + std::chrono::seconds(20);
    while (Clock::now() < end)
      if (auto frame = link.next(milliseconds(20)); !frame) return frame.error().message;
    return std::string();
  };
  auto silent = sources::connect_http_camera(address_of(server->url()), milliseconds(200));
  ASSERT_TRUE(silent);
  const auto first = (*silent)->next(std::chrono::seconds(10));
  ASSERT_TRUE(first && *first);
  server->is_silent = true;
  EXPECT_EQ(lost_of(**silent), "has sent nothing for 0.2 s");
  *silent = nullptr;
  server->is_silent = false;
  const auto ended = sources::connect_http_camera(address_of(server->url()));
  ASSERT_TRUE(ended);
  const std::string url = server->url();
  server.reset();
  EXPECT_EQ(lost_of(**ended), "has ended the connection");
  const auto nobody = sources::connect_http_camera(address_of(url));
  ASSERT_FALSE(nobody);
  EXPECT_NE(nobody.error().message.find("cannot be reached"), std::string::npos) << nobody.error().message;
}

TEST(HttpCamera, LeavesOutPicturesThatAreNoneAndNamesTheirCamera) {
  const MjpegServer server({"not a picture"});
  const auto source = open_live_source(server.url(), {}, {});
  ASSERT_TRUE(source);
  const auto frame = frame_of(**source);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().sentence(), server.url() + ": sends pictures that are not JPEG");
}

}  // namespace
}  // namespace palpable::session
