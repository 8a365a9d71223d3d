// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture.hpp"

#include <algorithm>

#include "program.hpp"
#include "test_pictures.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;

class StereoCommands : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write_pair(folder_.string(), textured_pair());
  }
};

TEST_F(StereoCommands, DepthOfAPairIsNearTheTruth) {
  const Outcome depth =
      palpable({"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"), "--json"});
  ASSERT_EQ(depth.exit_code, 0) << depth.err;
  const auto json = depth.json();
  EXPECT_EQ(json["width"], 160);
  EXPECT_EQ(json["height"], 120);
  EXPECT_GT(json["coverage"], 0.5);
  EXPECT_GE(json["seconds"], 0.0);
  EXPECT_TRUE(json["method"].is_string());
  const Outcome score = palpable({"score", "disparity", path("d.pfm"), path("truth.pfm"), "--json"});
  ASSERT_EQ(score.exit_code, 0) << score.err;
  EXPECT_EQ(score.json()["pixels"], 160 * 120);
  EXPECT_LT(score.json()["bad"]["2"], 25.0);
  EXPECT_GE(score.json()["bad"]["0.5"], score.json()["bad"]["1"]);
}

TEST_F(StereoCommands, DepthAsPngHoldsTheSameDisparityTimes256) {
  for (const char* name : {"d.pfm", "d.png"})
    ASSERT_EQ(palpable({"depth", path("left.png"), path("right.png"), "-o", path(name)}).exit_code, 0);
  const auto score = palpable({"score", "disparity", path("d.png"), path("d.pfm"), "--json"}).json();
  EXPECT_EQ(score["bad"]["0.5"], 0.0);
  EXPECT_LT(score["rms_px"], 1.0 / 256.0);
}

TEST_F(StereoCommands, TheSameInputGivesTheSameBytesWhateverTheThreads) {
  ASSERT_EQ(palpable({"depth", path("left.png"), path("right.png"), "-o", path("a.pfm"), "--threads", "1"})
                .exit_code,
            0);
  ASSERT_EQ(palpable({"depth", path("left.png"), path("right.png"), "-o", path("b.pfm"), "--threads", "3"})
                .exit_code,
            0);
  EXPECT_EQ(read_text(path("a.pfm")), read_text(path("b.pfm")));
}

/// The right picture `rows` lower, as a camera that stands higher sees it.
Raster<Rgb8> lowered(const Raster<Rgb8>& picture, int rows) {
  Raster<Rgb8> out = picture;
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out(x, y) = picture(x, std::max(0, y - rows));
  return out;
}

TEST_F(StereoCommands, APairOnDifferentScanlinesIsAlignedAndTheFiguresAreSaid) {
  const Pair pair = textured_pair(320, 240);
  ASSERT_TRUE(formats::write_png(path("left.png"), pair.left));
  ASSERT_TRUE(formats::write_png(path("low.png"), lowered(pair.right, 9)));
  ASSERT_TRUE(formats::write_pfm(path("truth.pfm"), pair.disparity_px));
  const Outcome depth = palpable({"depth", path("left.png"), path("low.png"), "-o", path("d.pfm"),
                                  "--aligned", path("al"), "--method", "fast", "--json"});
  ASSERT_EQ(depth.exit_code, 0) << depth.err;
  const auto alignment = depth.json()["alignment"];
  EXPECT_EQ(alignment["by"], "features");
  EXPECT_NEAR(alignment["residual_before_px"], 9.0, 1.0);
  EXPECT_LE(alignment["residual_px"], 0.5);
  EXPECT_THAT(depth.err, HasSubstr("were aligned"));
  EXPECT_TRUE(std::filesystem::exists(path("al_left.png")) && std::filesystem::exists(path("al_right.png")));
  const auto bad_percent = [&] {
    return palpable({"score", "disparity", path("d.pfm"), path("truth.pfm"), "--json"})
        .json()["bad"]["2"]
        .get<double>();
  };
  const double aligned_percent = bad_percent();
  ASSERT_TRUE(formats::write_png(path("right.png"), pair.right));
  ASSERT_EQ(palpable({"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"), "--method", "fast"})
                .exit_code,
            0);
  EXPECT_LT(aligned_percent, bad_percent() + 5.0);
  const Outcome raw = palpable({"depth", path("left.png"), path("low.png"), "-o", path("d.pfm"), "--align",
                                "off", "--method", "fast", "--json"});
  EXPECT_EQ(raw.json()["alignment"]["by"], "nothing");
  EXPECT_TRUE(raw.json()["alignment"]["residual_px"].is_null());
}

TEST_F(StereoCommands, AnAlignedPairIsLeftAlone) {
  const Outcome depth = palpable(
      {"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"), "--method", "fast", "--json"});
  EXPECT_EQ(depth.json()["alignment"]["by"], "nothing");
}

TEST_F(StereoCommands, TheFrontViewIsAPictureBetweenTheTwo) {
  for (const char* texture : {"left", "front", "none"})
    ASSERT_EQ(palpable({"make", path("left.png"), path("right.png"), "-o",
                        path(std::string(texture) + ".palp"), "--method", "fast", "--texture", texture})
                  .exit_code,
              0);
  EXPECT_NE(read_text(path("left.palp")), read_text(path("front.palp")));
  EXPECT_LT(std::filesystem::file_size(path("none.palp")), std::filesystem::file_size(path("left.palp")));
}

TEST_F(StereoCommands, AnUnknownMethodIsNamedWithThoseThatThereAre) {
  const Outcome outcome =
      palpable({"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"), "--method", "scanlin"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_sentence(outcome.err));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean scanline?"));
  EXPECT_FALSE(std::filesystem::exists(path("d.pfm")));
}

TEST_F(StereoCommands, ScoreTakesScaleAndMask) {
  const Outcome perfect = palpable({"score", "disparity", path("truth.pfm"), path("truth.pfm"), "--json"});
  EXPECT_EQ(perfect.json()["bad"]["0.5"], 0.0);
  EXPECT_EQ(perfect.json()["coverage"], 1.0);
  const Outcome doubled =
      palpable({"score", "disparity", path("truth.pfm"), path("truth.pfm"), "--truth-scale", "2", "--json"});
  EXPECT_EQ(doubled.json()["bad"]["1"], 100.0);
}

}  // namespace
}  // namespace palpable::test
