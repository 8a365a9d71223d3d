// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/frame_folder.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::sources {
namespace {

namespace fs = std::filesystem;

/// An empty folder for one test.
fs::path empty_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("frames-" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

/// A frame whose pixels all have this number, and one without a reading.
void write_frame(const fs::path& folder, const std::string& name, int value) {
  cv::Mat depth(4, 6, CV_16U, cv::Scalar(value));
  depth.at<std::uint16_t>(0, 0) = 0;
  ASSERT_TRUE(cv::imwrite((folder / (name + ".depth.png")).string(), depth));
}

TEST(FrameFolder, ListsFramesInNaturalOrderAndReadsMillimetres) {
  const auto folder = empty_folder("order");
  write_frame(folder, "frame-10", 3000);
  write_frame(folder, "frame-2", 2000);
  std::ofstream(folder / "frame-2.color.png") << "not a picture";
  std::ofstream(folder / "notes.txt") << "not a frame";
  const auto frames = FrameFolder::open(folder);
  ASSERT_TRUE(frames) << frames.error().sentence();
  ASSERT_EQ(frames->size(), 2U);
  const auto first = frames->depth(0);
  ASSERT_TRUE(first) << first.error().sentence();
  EXPECT_FLOAT_EQ(first->depth_m(3, 2), 2.0F);
  EXPECT_TRUE(std::isnan(first->depth_m(0, 0)));
  EXPECT_EQ(frames->colour(0).error().code, ErrorCode::invalid_input);
  EXPECT_EQ(frames->colour(1).error().code, ErrorCode::invalid_input);
}

TEST(FrameFolder, PairsADepthWithItsColourByName) {
  const auto frames =
      frames_among({".depth.png", "a10.depth.png", "a2.color.jpg", "a2.depth.png", "b.color.png"});
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].depth, "a2.depth.png");
  EXPECT_EQ(frames[0].colour, "a2.color.jpg");
  EXPECT_EQ(frames[1].depth, "a10.depth.png");
  EXPECT_EQ(frames[1].colour, "");
}

TEST(FrameFolder, ListsPairsWhereThereIsNoDepth) {
  const auto frames = frames_among({"a10.left.png", "a10.right.jpg", "a2.left.jpg", "a2.right.jpg",
                                    "a3.left.png", "a4.right.png", "left.png", "right.png"});
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].colour, "a2.left.jpg");
  EXPECT_EQ(frames[0].right, "a2.right.jpg");
  EXPECT_EQ(frames[1].colour, "a10.left.png");
  EXPECT_EQ(frames[1].right, "a10.right.jpg");
  EXPECT_EQ(frames_among({"a.depth.png", "a.left.png", "a.right.png"}).at(0).depth, "a.depth.png");
}

TEST(FrameFolder, ReadsPairs) {
  const auto folder = empty_folder("pairs");
  for (const auto& [name, level] : {std::pair("1.left.png", 10), std::pair("1.right.png", 20)})
    ASSERT_TRUE(cv::imwrite((folder / name).string(), cv::Mat(4, 6, CV_8U, cv::Scalar(level))));
  const auto frames = FrameFolder::open(folder);
  ASSERT_TRUE(frames) << frames.error().sentence();
  EXPECT_TRUE(frames->has_pairs());
  const auto pair = frames->pair(0);
  ASSERT_TRUE(pair) << pair.error().sentence();
  EXPECT_NEAR(pair->first.samples[0], 10.0F / 255.0F, 1e-6F);
  EXPECT_NEAR(pair->second.samples[0], 20.0F / 255.0F, 1e-6F);
  fs::remove(folder / "1.right.png");
  EXPECT_EQ(frames->pair(0).error().code, ErrorCode::invalid_input);
}

TEST(FrameFolder, TakesTheScaleOfASidecar) {
  const auto folder = empty_folder("scale");
  write_frame(folder, "a", 5000);
  std::ofstream(folder / "depth.json") << R"({"meaning": "depth", "metres_per_unit": 0.0002})";
  const auto frames = FrameFolder::open(folder);
  ASSERT_TRUE(frames) << frames.error().sentence();
  EXPECT_FLOAT_EQ(frames->depth(0)->depth_m(1, 1), 1.0F);
  std::ofstream(folder / "depth.json") << R"({"scale": 5000})";
  EXPECT_FLOAT_EQ(FrameFolder::open(folder)->depth(0)->depth_m(1, 1), 1.0F);
  std::ofstream(folder / "depth.json") << R"({"meaning": "disparity"})";
  EXPECT_EQ(FrameFolder::open(folder).error().code, ErrorCode::invalid_input);
}

TEST(FrameFolder, GivesAFrameInWhichNothingIsSeen) {
  const auto folder = empty_folder("dark");
  write_frame(folder, "a", 0);
  const auto dark = FrameFolder::open(folder)->depth(0);
  ASSERT_TRUE(dark) << dark.error().sentence();
  EXPECT_TRUE(std::isnan(dark->depth_m(3, 3)));
}

TEST(FrameFolder, RefusesAFolderWithoutFrames) {
  const auto folder = empty_folder("none");
  EXPECT_EQ(FrameFolder::open(folder).error().code, ErrorCode::invalid_input);
  EXPECT_EQ(FrameFolder::open(folder / "missing").error().code, ErrorCode::invalid_input);
}

TEST(FrameFolder, NamesAFrameThatCannotBeRead) {
  const auto folder = empty_folder("damaged");
  write_frame(folder, "a", 1000);
  std::ofstream(folder / "b.depth.png") << "rubbish";
  const auto frames = FrameFolder::open(folder);
  ASSERT_TRUE(frames);
  EXPECT_TRUE(frames->depth(0));
  const auto damaged = frames->depth(1);
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().sentence().find("b.depth.png"), std::string::npos);
}

TEST(FrameFolder, DoesNotWaitForAPipeThatTookTheFramesPlace) {
  const auto folder = empty_folder("pipe");
  write_frame(folder, "a", 1000);
  std::ofstream(folder / "a.color.png") << "not yet a pipe";
  const auto frames = FrameFolder::open(folder);
  ASSERT_TRUE(frames);
  for (const char* name : {"a.depth.png", "a.color.png"}) {
    fs::remove(folder / name);
    ASSERT_EQ(mkfifo((folder / name).c_str(), S_IRUSR | S_IWUSR), 0);
  }
  // A writer that stays silent: reading would never end.
  const int depth_writer = open((folder / "a.depth.png").c_str(), O_RDWR | O_CLOEXEC);
  const auto depth = frames->depth(0);
  ASSERT_FALSE(depth);
  EXPECT_NE(depth.error().sentence().find("a.depth.png"), std::string::npos);
  EXPECT_NE(depth.error().message.find("pipe"), std::string::npos);
  EXPECT_FALSE(frames->colour(0));
  close(depth_writer);
}

TEST(FrameFolder, ReadsWhereTheCameraWasAndItsIntrinsics) {
  const auto folder = empty_folder("posed");
  for (const char* name : {"a", "b", "c"}) write_frame(folder, name, 1000);
  std::ofstream(folder / "a.pose.txt") << "0 -1 0 0.5\n1 0 0 -2e-1\n0 0 1 3\n0 0 0 1\n";
  std::ofstream(folder / "b.pose.txt") << "1 0 0 0  0 2 0 0  0 0 1 0  0 0 0 1";
  std::ofstream(folder / "intrinsics.K.txt") << "600 0 2.5\n0 610 1.5\n0 0 1\n";
  const auto frames = FrameFolder::open(folder);
  ASSERT_TRUE(frames) << frames.error().sentence();
  const auto pose = frames->pose(0);
  ASSERT_TRUE(pose) << pose.error().sentence();
  ASSERT_TRUE(*pose);
  EXPECT_EQ((*pose)->translation_m, (Vec3{0.5, -0.2, 3.0}));
  EXPECT_EQ((*pose)->rotate({1, 0, 0}), (Vec3{0, 1, 0}));
  // A scale of 2 is no rotation; and none is stated of the last frame.
  EXPECT_EQ(frames->pose(1).error().code, ErrorCode::invalid_input);
  EXPECT_FALSE(frames->pose(2)->has_value());
  const auto depth = frames->depth(0);
  ASSERT_TRUE(depth);
  ASSERT_TRUE(depth->camera);
  EXPECT_EQ(*depth->camera, (Pinhole{600, 610, 2.5, 1.5, 6, 4}));
}

TEST(FrameFolder, RefusesIntrinsicsThatAreNone) {
  const auto folder = empty_folder("intrinsics");
  write_frame(folder, "a", 1000);
  for (const char* text : {"600 0 2.5 0 610", "600 0 x 0 610 1.5 0 0 1", "-600 0 2.5 0 610 1.5 0 0 1"}) {
    std::ofstream(folder / "camera-intrinsics.txt") << text;
    EXPECT_FALSE(FrameFolder::open(folder)) << text;
  }
}

TEST(FrameFolder, RefusesAFrameThatIsTooLargeToKeepUpWith) {
  const auto folder = empty_folder("large");
  ASSERT_TRUE(cv::imwrite((folder / "a.depth.png").string(), cv::Mat(2049, 4096, CV_16U, cv::Scalar(1000))));
  const auto frames = FrameFolder::open(folder);
  ASSERT_TRUE(frames);
  const auto depth = frames->depth(0);
  ASSERT_FALSE(depth);
  EXPECT_EQ(depth.error().code, ErrorCode::invalid_input);
  EXPECT_NE(depth.error().message.find("8392704 pixels"), std::string::npos) << depth.error().message;
}

}  // namespace
}  // namespace palpable::sources
