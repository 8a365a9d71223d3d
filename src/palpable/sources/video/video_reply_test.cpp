// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/video/video_reply.hpp"

#include <string>

#include <gmock/gmock.h>

namespace palpable::sources::isolated {
namespace {

Video small_video() {
  Video video{{}, 8, 4, 3};
  for (const int number : {0, 2, 4}) {
    VideoFrame frame{number, Raster<Rgb8>(4, 2)};
    frame.picture(1, 1) = {static_cast<std::uint8_t>(number), 7, 9};
    video.frames.push_back(frame);
  }
  return video;
}

TEST(VideoReply, RestoresEveryFrame) {
  const Video video = small_video();
  const auto back = video_in(reply_of(video));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->frames.size(), 3U);
  EXPECT_EQ(back->full_width, 8);
  EXPECT_EQ(back->lost, 3);
  EXPECT_EQ(back->frames[2].number, 4);
  EXPECT_EQ(back->frames[2].picture, video.frames[2].picture);
}

TEST(VideoReply, IsRefusedIfTruncatedTooLongOrWithInvalidNumbers) {
  auto bytes = reply_of(small_video());
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(video_in(std::span(bytes).first(length))) << length;
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(video_in(bytes));
  bytes.pop_back();
  Video twice = small_video();
  twice.frames[1].number = 0;
  EXPECT_FALSE(video_in(reply_of(twice)));
}

// YUV4MPEG2: a video format that is simple to write.
std::string video_file(int width, int height, int frames) {
  std::string out =
      "YUV4MPEG2 W" + std::to_string(width) + " H" + std::to_string(height) + " F30:1 Ip A1:1 C420jpeg\n";
  const auto pixels = static_cast<std::size_t>(width * height);
  for (int i = 0; i < frames; ++i) {
    out += "FRAME\n";
    out += std::string(pixels, static_cast<char>(40 * i + 20));
    out += std::string(pixels / 2, static_cast<char>(128));
  }
  return out;
}

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

TEST(DecodeVideo, GivesTheFramesOfAVideo) {
  const auto video = decode_video(bytes_of(video_file(32, 16, 5)));
  ASSERT_TRUE(video) << video.error().sentence();
  ASSERT_EQ(video->frames.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(video->frames[static_cast<std::size_t>(i)].number, i);
    EXPECT_EQ(video->frames[static_cast<std::size_t>(i)].picture.width(), 32);
  }
  EXPECT_LT(video->frames[0].picture(5, 5).g + 100, video->frames[4].picture(5, 5).g);
}

TEST(DecodeVideo, ReducesLongSides) {
  const auto video = decode_video(bytes_of(video_file(1920, 40, 2)));
  ASSERT_TRUE(video) << video.error().sentence();
  EXPECT_EQ(video->frames[0].picture.width(), kLongestVideoSide);
  EXPECT_EQ(video->frames[0].picture.height(), 20);
  EXPECT_EQ(video->full_width, 1920);
}

TEST(DecodeVideo, RefusesOtherFiles) {
  EXPECT_FALSE(decode_video(bytes_of(std::string("no video at all, but some words"))));
  EXPECT_FALSE(decode_video(bytes_of(video_file(32, 16, 0))));
  EXPECT_FALSE(decode_video(std::span<const std::byte>()));
}

}  // namespace
}  // namespace palpable::sources::isolated
