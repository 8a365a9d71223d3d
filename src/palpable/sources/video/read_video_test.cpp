// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/video/read_video.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/sources/video/video_reply.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

// 12 frames of 48 x 32 pixels, of which an edit list shows 7, as phones trim videos.
const std::filesystem::path kTrimmed = std::filesystem::path(PALPABLE_VIDEO_EXAMPLES) / "trimmed.mp4";

TEST(ReadVideo, FramesThatAVideoWasTrimmedByAreNotLost) {
  const auto video = read_video({&kTrimmed, 1}, {});
  ASSERT_TRUE(video) << video.error().sentence();
  EXPECT_EQ(video->frames.size(), 7U);
  EXPECT_EQ(video->lost, 0);
}

TEST(ReadVideo, FramesThatADamagedVideoStatesAreLost) {
  auto bytes = read_file(kTrimmed);
  ASSERT_TRUE(bytes);
  // The pictures begin behind the first 48 bytes; the description of all frames is at the end.
  constexpr std::ptrdiff_t kPictures = 48, kSome = 1500;
  std::fill_n(bytes->begin() + kPictures + kSome / 2, kSome / 2, std::byte{0});
  const auto video = isolated::decode_video(*bytes);
  ASSERT_TRUE(video) << video.error().sentence();
  EXPECT_GT(video->lost, 0);
  EXPECT_EQ(static_cast<int>(video->frames.size()) + video->lost, 7);
}

TEST(ReadVideo, ADamagedPictureOfAFolderDoesNotStopTheOthers) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::vector<std::filesystem::path> files{folder / "cut.ppm", folder / "whole.ppm",
                                                 folder / "again.ppm"};
  const std::string whole = "P6 2 1 255\nabcdef";
  std::ofstream(files[0]) << whole.substr(0, whole.size() - 2);
  std::ofstream(files[1]) << whole;
  std::ofstream(files[2]) << whole;
  const auto video = read_video(files, {});
  ASSERT_TRUE(video) << video.error().sentence();
  ASSERT_EQ(video->frames.size(), 2U);
  EXPECT_EQ(video->frames[0].number, 1);
  EXPECT_EQ(video->full_width, 2);
  EXPECT_EQ(video->lost, 1);
  ASSERT_TRUE(video->first_lost);
  EXPECT_EQ(video->first_lost->place, files[0].string());
}

TEST(ReadVideo, PicturesOfWhichNoneCanBeReadAreAnError) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::vector<std::filesystem::path> files{folder / "cut_1.ppm", folder / "cut_2.ppm"};
  for (const auto& file : files) std::ofstream(file) << "P6 2 1 255\nab";
  const auto video = read_video(files, {});
  ASSERT_FALSE(video);
  EXPECT_EQ(video.error().place, files[0].string());
}

}  // namespace
}  // namespace palpable::sources
