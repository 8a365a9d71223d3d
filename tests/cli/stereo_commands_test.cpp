// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"

#include <algorithm>
#include <tuple>

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

TEST_F(StereoCommands, DepthOfAPairIsAccurate) {
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

TEST_F(StereoCommands, OutputDoesNotDependOnTheNumberOfThreads) {
  ASSERT_EQ(palpable({"depth", path("left.png"), path("right.png"), "-o", path("a.pfm"), "--threads", "1"})
                .exit_code,
            0);
  ASSERT_EQ(palpable({"depth", path("left.png"), path("right.png"), "-o", path("b.pfm"), "--threads", "3"})
                .exit_code,
            0);
  EXPECT_EQ(read_text(path("a.pfm")), read_text(path("b.pfm")));
}

/// The picture shifted down by `rows`, as from a higher camera.
Raster<Rgb8> lowered(const Raster<Rgb8>& picture, int rows) {
  Raster<Rgb8> out = picture;
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out(x, y) = picture(x, std::max(0, y - rows));
  return out;
}

TEST_F(StereoCommands, AVerticallyShiftedPairIsRectifiedWithFigures) {
  const Pair pair = textured_pair(320, 240);
  ASSERT_TRUE(formats::write_png(path("left.png"), pair.left));
  ASSERT_TRUE(formats::write_png(path("low.png"), lowered(pair.right, 9)));
  ASSERT_TRUE(formats::write_pfm(path("truth.pfm"), pair.disparity_px));
  const Outcome depth =
      palpable({"depth", path("left.png"), path("low.png"), "-o", path("d.pfm"), "--rectified", path("al"),
                "--confidence", path("sure.png"), "--method", "fast", "--json"});
  ASSERT_EQ(depth.exit_code, 0) << depth.err;
  EXPECT_TRUE(std::filesystem::exists(path("sure.png")));
  const auto rectification = depth.json()["rectification"];
  EXPECT_EQ(rectification["by"], "features");
  EXPECT_NEAR(rectification["residual_before_px"], 9.0, 1.0);
  EXPECT_LE(rectification["residual_px"], 0.5);
  EXPECT_THAT(depth.err, HasSubstr("matched along that direction"));
  EXPECT_TRUE(std::filesystem::exists(path("al_left.png")) && std::filesystem::exists(path("al_right.png")));
  const auto bad_percent = [&] {
    return palpable({"score", "disparity", path("d.pfm"), path("truth.pfm"), "--json"})
        .json()["bad"]["2"]
        .get<double>();
  };
  const double rectified_percent = bad_percent();
  ASSERT_TRUE(formats::write_png(path("right.png"), pair.right));
  ASSERT_EQ(palpable({"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"), "--method", "fast"})
                .exit_code,
            0);
  EXPECT_LT(rectified_percent, bad_percent() + 5.0);
  const Outcome raw = palpable({"depth", path("left.png"), path("low.png"), "-o", path("d.pfm"), "--rectify",
                                "off", "--method", "fast", "--json"});
  EXPECT_EQ(raw.json()["rectification"]["by"], "nothing");
  EXPECT_TRUE(raw.json()["rectification"]["residual_px"].is_null());
}

TEST_F(StereoCommands, ARectifiedPairIsNotChanged) {
  const Outcome depth = palpable(
      {"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"), "--method", "fast", "--json"});
  EXPECT_EQ(depth.json()["rectification"]["by"], "nothing");
}

TEST_F(StereoCommands, TheFrontViewIsBetweenBothPictures) {
  for (const char* texture : {"left", "front", "none"})
    ASSERT_EQ(palpable({"make", path("left.png"), path("right.png"), "-o",
                        path(std::string(texture) + ".palp"), "--method", "fast", "--texture", texture})
                  .exit_code,
              0);
  EXPECT_NE(read_text(path("left.palp")), read_text(path("front.palp")));
  EXPECT_LT(std::filesystem::file_size(path("none.palp")), std::filesystem::file_size(path("left.palp")));
}

TEST_F(StereoCommands, CompareWritesOneTableAndOnePictureForAllMethods) {
  const Outcome compared = palpable({"compare", path("left.png"), path("right.png"), "--truth",
                                     path("truth.pfm"), "-o", path("all.png"), "--json"});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const auto methods = compared.json()["methods"];
  ASSERT_EQ(methods.size(), 6U);
  for (const auto& method : methods) {
    EXPECT_LT(method["score"]["bad"]["2"], 40.0) << method["method"];
    EXPECT_TRUE(method["score"]["normal_error_deg"].is_number()) << method["method"];
    EXPECT_TRUE(method["score"]["spurious_steps_per_cm"].is_number()) << method["method"];
  }
  EXPECT_TRUE(std::filesystem::exists(path("all.png")));
}

TEST_F(StereoCommands, FitPrintsOneSentenceAndDrawsOnePicture) {
  const Outcome fit = palpable({"fit", path("left.png"), path("right.png"), "-o", path("fit.png"), "--json"});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_THAT(fit.json()["sentence"].get<std::string>(), HasSubstr("fit to touch"));
  EXPECT_GT(fit.json()["agreement"], 0.6);
  EXPECT_TRUE(std::filesystem::exists(path("fit.png")));
}

TEST_F(StereoCommands, ACameraThatDidNotMoveIsReportedWithAFigure) {
  const Pair pair = textured_pair(320, 240);
  ASSERT_TRUE(formats::write_png(path("left.png"), pair.left));
  const Outcome still = palpable({"depth", path("left.png"), path("left.png"), "-o", path("d.pfm"),
                                  "--method", "fast", "--moved", "50", "--json"});
  ASSERT_EQ(still.exit_code, 0) << still.err;
  EXPECT_THAT(still.err, HasSubstr("hardly moved"));
  EXPECT_THAT(still.err, HasSubstr("0.00 pixels"));
}

TEST_F(StereoCommands, CalibrateReportsProblemsOfAFolder) {
  for (const auto& [folder, board, code, reason] :
       {std::tuple{path(""), "9x6", 3, "was found in 0 of"},
        std::tuple{path("none"), "9x6", 3, "No such file"}, std::tuple{path(""), "9", 2, "is not a board"}}) {
    const Outcome outcome = palpable({"calibrate", folder, "-o", path("c.yml"), "--board", board});
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err));
    EXPECT_THAT(outcome.err, HasSubstr(reason));
    EXPECT_FALSE(std::filesystem::exists(path("c.yml")));
  }
}

TEST_F(StereoCommands, RectifyTakesCornersOrLinesAndRefusesOthers) {
  const Outcome cut = palpable({"rectify", path("left.png"), "-o", path("r.png"), "--corners",
                                "20,20 140,30 150,110 10,100", "--aspect", "3:2", "--json"});
  ASSERT_EQ(cut.exit_code, 0) << cut.err;
  EXPECT_NEAR(cut.json()["width"].get<double>() / cut.json()["height"].get<double>(), 1.5, 0.02);
  const Outcome lines = palpable({"rectify", path("left.png"), "-o", path("r.png"), "--lines",
                                  "0,20,150,30 0,110,150,100 10,0,20,110 150,0,140,110"});
  EXPECT_EQ(lines.exit_code, 0) << lines.err;
  for (const auto& [option, value, code] :
       {std::tuple{"--corners", "1,2 3,4", 2}, std::tuple{"--corners", "20,20 20,20 20,20 20,20", 3},
        std::tuple{"--lines", "0,0,9,9 0,0,9,9 0,0,9,9 0,0,9,9", 3}}) {
    const Outcome outcome = palpable({"rectify", path("left.png"), "-o", path("bad.png"), option, value});
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err));
    EXPECT_FALSE(std::filesystem::exists(path("bad.png")));
  }
}

TEST_F(StereoCommands, BackgroundIsRemovedReportedAndDrawn) {
  write_pair(folder_.string(), textured_pair(160, 120, 0.0));
  const Outcome made = palpable({"make", path("left.png"), path("right.png"), "-o", path("s.palp"),
                                 "--method", "fast", "--background", "remove", "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("The background covers"));
  EXPECT_THAT(palpable({"info", path("s.palp"), "--json"}).out, HasSubstr("background"));
  EXPECT_EQ(palpable({"show", path("s.palp"), "-o", path("s.png"), "--view", "regions"}).exit_code, 0);
  ASSERT_EQ(palpable({"make", path("left.png"), path("right.png"), "-o", path("t.palp"), "--method", "fast"})
                .exit_code,
            0);
  const Outcome none = palpable({"show", path("t.palp"), "-o", path("t.png"), "--view", "regions"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("has no regions"));
}

TEST_F(StereoCommands, AnUnknownMethodIsNamedWithTheKnownOnes) {
  const Outcome outcome =
      palpable({"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"), "--method", "scanlin"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_sentence(outcome.err));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean scanline?"));
  EXPECT_FALSE(std::filesystem::exists(path("d.pfm")));
}

TEST_F(StereoCommands, AnOptionOfAnotherMethodIsRefused) {
  const Outcome outcome = palpable(
      {"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"), "--method", "fast", "--features"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_sentence(outcome.err));
  EXPECT_THAT(outcome.err, HasSubstr("--features"));
  EXPECT_FALSE(std::filesystem::exists(path("d.pfm")));
}

TEST_F(StereoCommands, AMethodsParametersAreListedAndSet) {
  const Outcome all = palpable({"methods", "--json"});
  EXPECT_EQ(all.json()["methods"].size(), 6U);
  for (const auto& method : all.json()["methods"]) EXPECT_NE(method.at("paper"), "") << method;
  const Outcome fast = palpable({"methods", "fast", "--json"});
  const auto parameters = fast.json()["parameters"];
  const auto medians = std::find_if(parameters.begin(), parameters.end(),
                                    [](const auto& p) { return p["name"] == "medians"; });
  ASSERT_NE(medians, parameters.end());
  EXPECT_EQ((*medians)["default"], 2);
  EXPECT_EQ((*medians)["most"], 10);

  const auto disparity = [&](const std::string& set) {
    const Outcome depth = palpable({"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"),
                                    "--method", "fast", "--set", set});
    EXPECT_EQ(depth.exit_code, 0) << depth.err;
    return read_text(path("d.pfm"));
  };
  EXPECT_TRUE(disparity("medians=2") == disparity("large_step=120"));  // both are the defaults
  EXPECT_FALSE(disparity("medians=0") == disparity("medians=2"));
}

TEST_F(StereoCommands, UnknownAndInvalidParametersAreRefused) {
  const auto refused = [&](const std::string& set, const std::string& words) {
    const Outcome depth = palpable({"depth", path("left.png"), path("right.png"), "-o", path("new.pfm"),
                                    "--method", "fast", "--set", set});
    EXPECT_EQ(depth.exit_code, 2) << set;
    EXPECT_THAT(depth.err, HasSubstr(words)) << set;
    EXPECT_FALSE(std::filesystem::exists(path("new.pfm")));
  };
  refused("mediens=3", "did you mean medians?");
  refused("medians=11", "must lie between 0 and 10");
  refused("medians=2.5", "must be a whole number");
  refused("medians", "NAME=VALUE");
  refused("medians=two", "not a number");
  refused("cost.colour_limit=255", "more than 127");
}

TEST_F(StereoCommands, ScoreAsksForTheScaleOfAnEightBitTruth) {
  Raster<Rgb8> truth(160, 120);
  for (Rgb8& c : truth.values()) c = {40, 40, 40};
  ASSERT_TRUE(formats::write_png(path("truth.png"), truth));
  const Outcome unstated = palpable({"score", "disparity", path("truth.pfm"), path("truth.png")});
  EXPECT_EQ(unstated.exit_code, 3);
  EXPECT_TRUE(is_one_sentence(unstated.err));
  EXPECT_THAT(unstated.err, HasSubstr("--truth-scale"));
  const Outcome stated =
      palpable({"score", "disparity", path("truth.pfm"), path("truth.png"), "--truth-scale", "4"});
  EXPECT_EQ(stated.exit_code, 0) << stated.err;
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
