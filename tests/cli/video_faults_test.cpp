// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "program.hpp"
#include "test_videos.hpp"
#include <gmock/gmock.h>

// Video files that are not as they should be: each gives the best partial result and says what to do better.
namespace palpable::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kLandscape =
    R"({"fx": 220, "fy": 220, "cx": 119.5, "cy": 89.5, "width": 240, "height": 180})";
constexpr const char* kPortrait =
    R"({"fx": 220, "fy": 220, "cx": 89.5, "cy": 119.5, "width": 180, "height": 240})";

std::vector<Raster<Rgb8>> walk(int pictures, FilmedScene scene = FilmedScene::box) {
  std::vector<Raster<Rgb8>> out;
  for (int i = 0; i < pictures; ++i)
    out.push_back(picture_from(on_arc(-0.35 + 0.05 * i), {0, 0, 0.02}, scene));
  return out;
}

class FaultyVideos : public InFolder {
 protected:
  Outcome make(const std::string& video, const char* camera = kLandscape) const {
    write_text(path("camera.json"), camera);
    return palpable({"make", video, "-o", path("m.palp"), "--calibration", path("camera.json"),
                     "--resolution", "48", "--set", "video.depth.maps=5", "--poses", path("poses.csv"),
                     "--json"});
  }
  std::size_t posed() const {
    const std::string poses = read_text(path("poses.csv"));
    return static_cast<std::size_t>(std::count(poses.begin(), poses.end(), '\n')) - 1;
  }
};

TEST_F(FaultyVideos, ThatWereCutGiveTheLongerPartAndSaySo) {
  std::vector<Raster<Rgb8>> pictures = walk(14);
  for (const auto& picture : walk(8, FilmedScene::other_box)) pictures.push_back(picture);
  write_video(path("cut.mov"), pictures);
  const Outcome made = make(path("cut.mov"));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("The video was cut before frame 14"));
  EXPECT_EQ(posed(), 14U);
}

TEST_F(FaultyVideos, OfThreePicturesGiveAModelAndAskForMore) {
  write_video(path("short.mov"), walk(3));
  const Outcome made = make(path("short.mov"));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("There are only 3 pictures"));
  EXPECT_EQ(posed(), 3U);
}

TEST_F(FaultyVideos, OfOnePictureAreRefusedWithAReason) {
  write_video(path("one.mov"), walk(1));
  const Outcome made = make(path("one.mov"));
  EXPECT_EQ(made.exit_code, 3);
  EXPECT_THAT(made.err, HasSubstr("a single picture shows no depth"));
  EXPECT_TRUE(is_one_sentence(made.err)) << made.err;
  EXPECT_FALSE(std::filesystem::exists(path("m.palp")));
}

TEST_F(FaultyVideos, OfVariableFrameRateGiveWhatAConstantRateGives) {
  const std::vector<Raster<Rgb8>> pictures = walk(12);
  write_video(path("even.mov"), pictures);
  FilmedAs uneven;
  std::int64_t time = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    uneven.times.push_back(time);
    time += i % 3 == 0 ? 60 : i % 3 == 1 ? 7 : 211;
  }
  write_video(path("uneven.mov"), pictures, uneven);
  const Outcome even = make(path("even.mov"));
  ASSERT_EQ(even.exit_code, 0) << even.err;
  const std::string poses = read_text(path("poses.csv"));
  const Outcome made = make(path("uneven.mov"));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(posed(), pictures.size());
  EXPECT_EQ(read_text(path("poses.csv")), poses);
}

TEST_F(FaultyVideos, ThatAreDamagedUseTheReadablePicturesAndSayHowMany) {
  const std::string file = path("damaged.mov");
  write_video(file, walk(14));
  // The pictures come first, the description of all frames at the end.
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(file));
  {
    std::fstream damaged(file, std::ios::in | std::ios::out | std::ios::binary);
    damaged.seekp(size / 2);
    damaged << std::string(static_cast<std::size_t>(size / 8), 'x');
  }
  const Outcome made = make(file);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, testing::ContainsRegex("The file is damaged: [1-4] of its pictures"));
  EXPECT_GE(posed(), 8U);
  EXPECT_LT(posed(), 14U);
}

TEST_F(FaultyVideos, FilmedUprightAreTurnedAsThePhoneSays) {
  FilmedAs upright;
  upright.turns = 1;
  write_video(path("portrait.mov"), walk(12), upright);
  const Outcome made = make(path("portrait.mov"), kPortrait);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(posed(), 12U);
  // The calibration of pictures that were not turned does not fit.
  EXPECT_EQ(make(path("portrait.mov"), kLandscape).exit_code, 3);
}

}  // namespace
}  // namespace palpable::test
