// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/video_device.hpp"

#include "palpable/sources/live/camera_stream.hpp"
#include "palpable/sources/live/test_video_calls.hpp"

#include <chrono>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

using std::chrono::milliseconds;

VideoDevice second() {
  VideoDevice device;
  device.number = 2;
  return device;
}

std::string text_of(const CameraFrame& frame) {
  return {reinterpret_cast<const char*>(frame.bytes.data()), frame.bytes.size()};
}

/// The sentence with which opening fails.
std::string refusal(FakeCamera& camera, const VideoDevice& device) {
  const auto link = open_video_device(device, camera);
  EXPECT_EQ(camera.open_count, link ? 1 : 0);
  return link ? "" : link.error().message;
}

TEST(VideoDevice, GivesTheNewestPictureAndCountsAll) {
  FakeCamera camera;
  auto device = second();
  device.rate_hz = 15;
  {
    const auto link = open_video_device(device, camera);
    ASSERT_TRUE(link) << link.error().message;
    EXPECT_TRUE(camera.is_on);
    EXPECT_EQ(camera.rate_hz, 15U);
    EXPECT_EQ(camera.mapped, 4);
    camera.pictures = {"one", "", "two"};
    const auto newest = (*link)->next(milliseconds(1));
    ASSERT_TRUE(newest && *newest);
    EXPECT_EQ(text_of(**newest), "two");
    EXPECT_EQ((*newest)->number, 1U);
    EXPECT_EQ((*newest)->coding, CameraCoding::jpeg);
    // More pictures than buffers: a call takes as many as there are buffers.
    for (int k = 0; k < 9; ++k) camera.pictures.push_back(std::to_string(k));
    EXPECT_EQ(text_of(**(*link)->next(milliseconds(1))), "3");
    EXPECT_EQ(text_of(**(*link)->next(milliseconds(1))), "7");
    camera.pictures.clear();
    EXPECT_FALSE(*(*link)->next(milliseconds(1)));
  }
  EXPECT_FALSE(camera.is_on);
  EXPECT_EQ(camera.mapped, 0);
  EXPECT_EQ(camera.open_count, 0);
}

TEST(VideoDevice, TakesYuyvWhereThereIsNoMjpeg) {
  FakeCamera camera;
  camera.coding = V4L2_PIX_FMT_YUYV;
  camera.width = 4;
  camera.height = 2;
  const auto link = open_video_device(second(), camera);
  ASSERT_TRUE(link) << link.error().message;
  camera.pictures = {std::string(16, '\x80')};
  const auto frame = (*link)->next(milliseconds(1));
  ASSERT_TRUE(frame && *frame);
  const auto picture = picture_of(**frame);
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->width, 4);
  EXPECT_EQ(picture->height, 2);
  // A black picture is one, and so has no depth; a cut one is an error.
  camera.pictures = {std::string(8, '\x10')};
  const auto cut = (*link)->next(milliseconds(1));
  ASSERT_TRUE(cut && *cut);
  EXPECT_FALSE(picture_of(**cut));
}

TEST(VideoDevice, SaysWhyACameraCannotBeOpened) {
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  FakeCamera camera;
  VideoDevice first;
  has(refusal(camera, first), "cameras: camera:2 (Test camera)");
  for (const auto& [request, why, words] :
       {std::tuple<unsigned long, int, const char*>{0, EACCES, "group video"},
        {0, EBUSY, "another program"},
        {VIDIOC_QUERYCAP, ENOTTY, "cameras: none"},
        {VIDIOC_S_FMT, EBUSY, "another program"},
        {VIDIOC_S_FMT, EINVAL, "neither MJPEG nor YUYV"},
        {VIDIOC_REQBUFS, EBUSY, "another program"},
        {VIDIOC_QUERYBUF, EIO, "has a fault"},
        {VIDIOC_STREAMON, ENOSPC, "USB"},
        {VIDIOC_STREAMON, ENODEV, "unplugged"}}) {
    camera.faults = {{request, why}};
    has(refusal(camera, second()), words);
    EXPECT_EQ(camera.mapped, 0);
  }
  camera.faults.clear();
  camera.capabilities = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
  has(refusal(camera, second()), "cameras: none");
  camera.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  auto larger = second();
  larger.width = 1280;
  larger.height = 480;
  has(refusal(camera, larger), "gives 320 x 96 pixels, not 1280 x 480");
  auto plain = second();
  plain.coding = CameraCoding::yuyv;
  has(refusal(camera, plain), "does not have this format");
  EXPECT_EQ(listed_cameras(camera), "camera:2 (Test camera)");
}

TEST(VideoDevice, IsLostWhenItIsUnpluggedOrFreezes) {
  FakeCamera camera;
  auto link = open_video_device(second(), camera, milliseconds(50));
  ASSERT_TRUE(link);
  EXPECT_FALSE(*(*link)->next(milliseconds(1)));
  const auto frozen = (*link)->next(milliseconds(60));
  ASSERT_FALSE(frozen);
  EXPECT_EQ(frozen.error().message, "has sent nothing for 0.1 s");
  camera.faults = {{VIDIOC_DQBUF, ENODEV}};
  EXPECT_EQ((*link)->next(milliseconds(1)).error().message, "was unplugged");
}

TEST(VideoDevice, ComesBackInAStream) {
  FakeCamera camera;
  camera.pictures = {"one"};
  // Only the stream's thread touches the camera after this.
  const auto stream = CameraStream::open(
      [&] { return open_video_device(second(), camera, milliseconds(30)); }, "camera:2", milliseconds(10));
  ASSERT_TRUE(stream);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  ASSERT_TRUE(*(*stream)->take(deadline));
  std::optional<std::string> loss;
  while (!loss && std::chrono::steady_clock::now() < deadline) loss = (*stream)->loss();
  ASSERT_TRUE(loss);
  EXPECT_EQ(*loss,
            "The camera camera:2 was lost: it has sent nothing for 0.0 s. It is tried again every second.");
}

}  // namespace
}  // namespace palpable::sources
