// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
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
