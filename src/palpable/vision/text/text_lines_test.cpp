// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/text_lines.hpp"

#include "palpable/vision/text/read_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>
#include <unistd.h>

namespace palpable::vision {
namespace {

/// Dark words on light grey, turned by an angle (clockwise, degrees) about the middle.
Raster<Rgb8> words_at(const std::string& words, double angle_deg) {
  constexpr int kSide = 300;
  cv::Mat canvas(kSide, kSide, CV_8UC3, cv::Scalar(225, 225, 225));
  constexpr double kScale = 0.6;
  int base = 0;
  const cv::Size size = cv::getTextSize(words, cv::FONT_HERSHEY_DUPLEX, kScale, 1, &base);
  cv::putText(canvas, words, {kSide / 2 - size.width / 2, kSide / 2 + size.height / 2},
              cv::FONT_HERSHEY_DUPLEX, kScale, cv::Scalar(30, 30, 30), 1, cv::LINE_AA);
  const cv::Mat turn = cv::getRotationMatrix2D({0.5F * kSide, 0.5F * kSide}, -angle_deg, 1.0);
  cv::warpAffine(canvas, canvas, turn, canvas.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  Raster<Rgb8> out(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const auto c = canvas.at<cv::Vec3b>(y, x);
      out(x, y) = {c[0], c[1], c[2]};
    }
  return out;
}

TEST(TextLines, FollowTheDirectionOfWordsAtAnyAngle) {
  for (const double angle : {0.0, 25.0, 60.0, -40.0, 90.0}) {
    const auto lines = find_text_lines(words_at("Station Road", angle));
    ASSERT_EQ(lines.size(), 1U) << angle;
    const MapPoint a = lines[0].centre.front();
    const MapPoint b = lines[0].centre.back();
    const double direction = std::atan2(b.y - a.y, b.x - a.x) * 180.0 / std::numbers::pi;
    EXPECT_NEAR(std::abs(std::remainder(direction - angle, 180.0)), 0.0, 3.0) << angle;
    EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), 135.0, 20.0) << angle;
    EXPECT_NEAR(lines[0].height_px, 13.0, 4.0) << angle;
    EXPECT_NEAR(0.5 * (a.x + b.x), 150.0, 6.0);
    EXPECT_NEAR(0.5 * (a.y + b.y), 150.0, 6.0);
  }
}

TEST(TextLines, ShortWordsBelongToTheirLine) {
  // "II" alone is higher than long: its direction is across the line.
  for (const char* words : {"Avenue Albert II", "I Market Place"})
    for (const double angle : {0.0, 25.0, 90.0}) {
      const auto lines = find_text_lines(words_at(words, angle));
      ASSERT_EQ(lines.size(), 1U) << words << ' ' << angle;
      int base = 0;
      const double width = cv::getTextSize(words, cv::FONT_HERSHEY_DUPLEX, 0.6, 1, &base).width;
      const MapPoint a = lines[0].centre.front(), b = lines[0].centre.back();
      EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), width, 5.0) << words << ' ' << angle;
    }
}

TEST(TextLines, MarksBesideALineAreNoWords) {
  // A square of the letters' size two heights below the end of the line.
  Raster<Rgb8> picture = words_at("Station Road", 0.0);
  for (int y = 172; y < 182; ++y)
    for (int x = 205; x < 209; ++x) picture(x, y) = {30, 30, 30};
  const auto lines = find_text_lines(picture);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].height_px, 13.0, 4.0);
}

TEST(TextLines, LeaveOutDashesAndLongThinLines) {
  Raster<Rgb8> picture(200, 100, {230, 230, 230});
  for (int x = 10; x < 190; ++x) {
    picture(x, 30) = {20, 20, 20};
    if (x % 10 < 6) picture(x, 60) = {20, 20, 20};
  }
  EXPECT_TRUE(find_text_lines(picture).empty());
}

TEST(ReadText, ReadsTurnedWordsTheRightWayUp) {
  for (const double angle : {0.0, 35.0, -90.0, 160.0}) {
    const Raster<Rgb8> picture = words_at("Station Road", angle);
    const auto lines = find_text_lines(picture);
    ASSERT_EQ(lines.size(), 1U);
    const auto read = read_text_lines(picture, lines, {}, Work{});
    ASSERT_TRUE(read);
    if (!read->notes.empty()) GTEST_SKIP() << read->notes.front().sentence;
    EXPECT_EQ(read->lines[0].text, "Station Road") << angle;
    EXPECT_GT(read->lines[0].confidence, 0.5) << angle;
  }
}

/// A program `tesseract` of these lines of sh, which is the only one that is found.
class FakeReader {
 public:
  explicit FakeReader(const std::string& script)
      : folder_(std::filesystem::temp_directory_path() /
                ("palpable-reader-" + std::to_string(static_cast<long>(::getpid())))),
        path_(std::getenv("PATH")) {
    std::filesystem::create_directory(folder_);
    std::ofstream(folder_ / "tesseract") << "#!/bin/sh\n" << script;
    std::filesystem::permissions(folder_ / "tesseract", std::filesystem::perms::owner_all);
    setenv("PATH", folder_.c_str(), 1);
  }
  FakeReader(const FakeReader&) = delete;
  FakeReader& operator=(const FakeReader&) = delete;
  ~FakeReader() {
    setenv("PATH", path_.c_str(), 1);
    std::filesystem::remove_all(folder_);
  }
  bool has(const char* file) const { return std::filesystem::exists(folder_ / file); }

 private:
  std::filesystem::path folder_;
  std::string path_;
};

constexpr const char* kSaysStation =
    "printf '5\\t1\\t1\\t1\\t1\\t1\\t0\\t0\\t9\\t9\\t60\\tStation\\n' > \"$2.tsv\"\n";

TextReading read_station(const ReadTextOptions& options) {
  const Raster<Rgb8> picture = words_at("Station Road", 0.0);
  auto read = read_text_lines(picture, find_text_lines(picture), options, Work{});
  EXPECT_TRUE(read) << read.error().sentence();
  return read ? *std::move(read) : TextReading{};
}

TEST(ReadText, AReaderThatFailsLaterLeavesAllUnread) {
  // A program that reads one unsure word, and fails when it is asked again.
  const FakeReader reader("[ -e \"$0.called\" ] && exit 1\n: > \"$0.called\"\n" + std::string(kSaysStation));
  ReadTextOptions options;
  options.languages = "eng";
  const TextReading read = read_station(options);
  ASSERT_TRUE(reader.has("tesseract.called"));
  ASSERT_EQ(read.lines.size(), 1U);
  EXPECT_EQ(read.lines[0].text, "");
  ASSERT_EQ(read.notes.size(), 1U);
}

TEST(ReadText, OnlyTheTimeInWhichAReaderComputesIsLimited) {
  ReadTextOptions options;
  options.languages = "eng";
  options.most_seconds = 1.0;
  {
    // On a busy machine a reader waits for the processor.
    const FakeReader waits("/bin/sleep 1.5\n" + std::string(kSaysStation));
    EXPECT_TRUE(read_station(options).notes.empty());
  }
  const FakeReader computes("while :; do :; done\n");
  const TextReading read = read_station(options);
  ASSERT_EQ(read.notes.size(), 1U);
  EXPECT_NE(read.notes[0].sentence.find("took too long"), std::string::npos) << read.notes[0].sentence;
}

TEST(ReadText, StopsWhenItIsCancelled) {
  const Raster<Rgb8> picture = words_at("Station Road", 0.0);
  const auto lines = find_text_lines(picture);
  const std::atomic<bool> cancel = true;
  Work work;
  work.cancel = &cancel;
  const auto read = read_text_lines(picture, lines, {}, work);
  if (read && !read->notes.empty()) GTEST_SKIP() << read->notes.front().sentence;
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace palpable::vision
