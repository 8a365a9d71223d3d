// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/camera_stream.hpp"

#include "palpable/sources/live/frame_folder.hpp"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// A camera that gives three frames at once, then is lost.
class ThreeFrames final : public CameraLink {
 public:
  Result<std::optional<CameraFrame>> next(milliseconds /*longest*/) override {
    if (given_ == 3) return invalid_input("was unplugged");
    return std::optional(CameraFrame{given_++, Clock::now(), CameraCoding::jpeg, 0, 0, {}});
  }

 private:
  std::uint64_t given_ = 0;
};

TEST(CameraStream, SaysEachLossOnceAndTriesAgain) {
  std::atomic<int> opened{0};
  const OpenLink open = [&]() -> Result<std::unique_ptr<CameraLink>> {
    // The second and third attempt fail.
    const int attempt = opened++;
    if (attempt == 1 || attempt == 2) return invalid_input("is missing");
    return std::unique_ptr<CameraLink>(std::make_unique<ThreeFrames>());
  };
  const auto stream = CameraStream::open(open, "camera:0", milliseconds(20));
  ASSERT_TRUE(stream);
  std::vector<std::string> losses;
  std::uint64_t newest = 0;
  const auto end = Clock::now() + std::chrono::seconds(20);
  while (Clock::now() < end && newest < 8) {
    const auto frame = (*stream)->take(Clock::now() + milliseconds(5));
    ASSERT_TRUE(frame) << frame.error().sentence();
    // Frames that nobody took are counted, and a new connection goes on with the numbers.
    if (*frame) newest = std::max(newest, (*frame)->number);
    if (const auto loss = (*stream)->loss()) losses.push_back(*loss);
  }
  EXPECT_GE(newest, 8U);
  ASSERT_GE(losses.size(), 2U);
  EXPECT_EQ(losses[0], "The camera camera:0 was lost: it was unplugged. It is tried again every second.");
  EXPECT_LE(static_cast<int>(losses.size()), opened - 2);
}

/// A camera that gives nothing.
class Nothing final : public CameraLink {
 public:
  explicit Nothing(bool fails) : fails_(fails) {}
  Result<std::optional<CameraFrame>> next(milliseconds longest) override {
    if (fails_) return invalid_input("answers with status 404");
    std::this_thread::sleep_for(longest);
    return std::optional<CameraFrame>();
  }

 private:
  bool fails_;
};

TEST(CameraStream, EndsWithACameraThatNeverGaveAPicture) {
  const auto link = [](bool fails) {
    return [fails]() -> Result<std::unique_ptr<CameraLink>> {
      return std::unique_ptr<CameraLink>(std::make_unique<Nothing>(fails));
    };
  };
  const auto silent = CameraStream::open(link(false), "a");
  ASSERT_TRUE(silent);
  EXPECT_FALSE(*(*silent)->take(Clock::now() + milliseconds(10)));
  const auto wrong = CameraStream::open(link(true), "a");
  ASSERT_TRUE(wrong);
  const auto frame = (*wrong)->take(Clock::now() + std::chrono::seconds(10));
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().sentence(), "a: answers with status 404");
  EXPECT_FALSE((*wrong)->loss());
  const auto none = CameraStream::open([] { return invalid_input("is missing"); }, "b");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().sentence(), "b: is missing");
}

TEST(PictureOf, ReadsPairsOfPixels) {
  const auto bytes = [](std::initializer_list<int> values) {
    std::vector<std::byte> out;
    for (const int value : values) out.push_back(static_cast<std::byte>(value));
    return out;
  };
  CameraFrame frame{0, {}, CameraCoding::yuyv, 2, 1, bytes({235, 128, 16, 128})};
  const auto grey = picture_of(frame);
  ASSERT_TRUE(grey) << grey.error().message;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(grey->pixel(0, 0)[c], 1.0F, 0.002F);
    EXPECT_NEAR(grey->pixel(1, 0)[c], 0.0F, 0.002F);
  }
  // Pure red is (81, 90, 240) in BT.601.
  frame.bytes = bytes({81, 90, 81, 240});
  const auto red = picture_of(frame);
  EXPECT_NEAR(red->pixel(0, 0)[0], 1.0F, 0.01F);
  EXPECT_NEAR(red->pixel(0, 0)[1], 0.0F, 0.01F);
  EXPECT_NEAR(red->pixel(0, 0)[2], 0.0F, 0.01F);
  frame.bytes.pop_back();
  EXPECT_FALSE(picture_of(frame));
  frame.width = 1;
  EXPECT_FALSE(picture_of(frame));
  frame.width = 4096;
  frame.height = 4096;
  EXPECT_NE(picture_of(frame).error().message.find(std::to_string(kMostFramePixels)), std::string::npos);
  EXPECT_FALSE(picture_of({0, {}, CameraCoding::jpeg, 0, 0, bytes({1, 2, 3})}));
  EXPECT_FALSE(picture_of({0, {}, CameraCoding::jpeg, 0, 0, bytes({0xFF, 0xD8, 0xFF, 0xE0})}));
}

}  // namespace
}  // namespace palpable::sources
