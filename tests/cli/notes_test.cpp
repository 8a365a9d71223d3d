// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What a command says of what it took, assumed and could not use.
#include "palpable/formats/picture/picture.hpp"

#include "program.hpp"
#include "test_pictures.hpp"
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Notes : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write_pair(folder_.string(), textured_pair());
    Raster<std::uint16_t> grey(96, 64);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 96; ++x)
        grey(x, y) = static_cast<std::uint16_t>(257 * ((x / 12 + y / 8) % 2 == 0 ? 40 : 200));
    ASSERT_TRUE(formats::write_png(path("grey16.png"), grey));
  }
};

TEST_F(Notes, SayThatA16BitPictureOf8BitValuesWasNotTakenAsDepth) {
  const Outcome outcome = palpable({"make", path("grey16.png"), "-o", path("out.palp")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("it was taken as a picture, not as depth"));
  EXPECT_THAT(outcome.err, HasSubstr("--kind depth"));
  const Outcome asked = palpable({"make", path("grey16.png"), "-o", path("out.palp"), "--as", "contours"});
  ASSERT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_THAT(asked.err, Not(HasSubstr("taken as a picture")));
}

TEST_F(Notes, SayWhichScenesALawIsForWhereItWasAskedFor) {
  ASSERT_EQ(
      palpable({"make", path("left.png"), path("right.png"), "-o", path("relief.palp"), "--method", "fast"})
          .exit_code,
      0);
  ASSERT_EQ(palpable({"make", path("left.png"), "-o", path("lines.palp")}).exit_code, 0);
  const auto touched = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "touch");
    arguments.insert(arguments.end(), {"--headless", "--seconds", "0.2"});
    return palpable(arguments).err;
  };
  EXPECT_THAT(
      touched({path("relief.palp"), "--law", "tracing"}),
      HasSubstr(
          "The law tracing is for contours, not for reliefs: this scene is touched with the law proxy."));
  EXPECT_THAT(touched({path("lines.palp"), "--law", "penalty"}), HasSubstr("not for contours"));
  // On a busy machine it may say that deadlines were missed.
  EXPECT_THAT(touched({path("lines.palp")}), Not(HasSubstr("law")));
}

TEST_F(Notes, NameTheFileWithItsFolderInTheCommandThatTheyPropose) {
  std::filesystem::create_directory(path("my pictures"));
  std::filesystem::copy_file(path("left.png"), path("my pictures/left.png"));
  const Outcome outcome = palpable({"show", path("my pictures/left.png"), "-o", path("out.png")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("palpable make '" + path("my pictures/left.png") + "' -o left.palp"));
}

TEST_F(Notes, NameTheOptionsThatHaveNoEffect) {
  const Outcome lines =
      palpable({"make", path("left.png"), "-o", path("out.palp"), "--max-error", "0.1", "--lay", "flat"});
  ASSERT_EQ(lines.exit_code, 0) << lines.err;
  EXPECT_THAT(lines.err, HasSubstr("--lay and --max-error have no effect on contours made from a picture."));
  const Outcome relief = palpable({"make", path("left.png"), path("right.png"), "-o", path("out.palp"),
                                   "--method", "fast", "--size", "90x90x12", "--groove", "3"});
  ASSERT_EQ(relief.exit_code, 0) << relief.err;
  EXPECT_THAT(relief.err, HasSubstr("--groove has no effect on a relief made from a pair."));
  const Outcome touched =
      palpable({"touch", path("out.palp"), "--headless", "--seconds", "0.2", "--size", "50x50x5"});
  EXPECT_THAT(touched.err, HasSubstr("--size has no effect on a relief made from a scene."));
}

TEST_F(Notes, NameTheParametersOfStepsThatAreNotUsed) {
  const auto noted = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "make");
    arguments.insert(arguments.end(), {"-o", path("out.palp")});
    const Outcome outcome = palpable(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(
      noted({path("left.png"), "--set", "field.resolution=64", "--set", "fusion.smoothing.passes=3", "--lay",
             "flat"}),
      HasSubstr("--lay, field.resolution and fusion.smoothing.passes have no effect on contours made from a "
                "picture."));
  EXPECT_THAT(noted({path("left.png"), "--contour-method", "paper", "--set",
                     "contours.standard.tensor_blur_px=3", "--set", "grooves.width_m=0.003"}),
              HasSubstr("contours.standard.tensor_blur_px has no effect with --contour-method paper."));
  const std::string relief = noted({path("left.png"), path("right.png"), "--method", "fast", "--detail",
                                    "bilateral", "--set", "detail.relief.detail_gain=0.2", "--set",
                                    "detail.bilateral.range=0.2", "--set", "ground.least_share=0.1"});
  EXPECT_THAT(relief, HasSubstr("detail.relief.detail_gain has no effect with --detail bilateral."));
  EXPECT_THAT(relief, HasSubstr("ground.least_share has no effect without --ground or --background."));
}

TEST_F(Notes, NameNoParameterThatIsUsed) {
  const Outcome lines = palpable({"make", path("left.png"), "-o", path("out.palp"), "--set",
                                  "contours.standard.tensor_blur_px=3", "--set", "grooves.width_m=0.003"});
  ASSERT_EQ(lines.exit_code, 0) << lines.err;
  EXPECT_THAT(lines.err, Not(HasSubstr("no effect")));
  const Outcome relief =
      palpable({"make", path("left.png"), path("right.png"), "-o", path("out.palp"), "--method", "fast",
                "--set", "preparation.stretch_below=0.3", "--set", "detail.relief.detail_gain=0.2"});
  ASSERT_EQ(relief.exit_code, 0) << relief.err;
  EXPECT_THAT(relief.err, Not(HasSubstr("no effect")));
}

TEST_F(Notes, NameTheNumbersThatTheLawDoesNotHave) {
  ASSERT_EQ(
      palpable({"make", path("left.png"), path("right.png"), "-o", path("relief.palp"), "--method", "fast"})
          .exit_code,
      0);
  write_text(path("path.csv"), "t_s,x_m,y_m,z_m\n0,0,0,0.02\n0.01,0,0,0\n");
  const auto noted = [&](std::vector<std::string> arguments) {
    const Outcome outcome = palpable(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(noted({"probe", path("relief.palp"), "--path", path("path.csv"), "-o", path("forces.csv"),
                     "--law", "rolling", "--friction", "0.4", "--tool-radius", "3"}),
              HasSubstr("--friction and --tool-radius have no effect with the law rolling."));
  EXPECT_THAT(noted({"touch", path("relief.palp"), "--headless", "--seconds", "0.2", "--law", "penalty",
                     "--friction", "0.4"}),
              HasSubstr("--friction has no effect with the law penalty."));
  EXPECT_THAT(noted({"touch", path("relief.palp"), "--headless", "--seconds", "0.2", "--friction", "0.4"}),
              Not(HasSubstr("no effect")));
}

TEST_F(Notes, AKindOfSceneIsNotAKindOfInput) {
  const Outcome outcome = palpable({"make", path("left.png"), "-o", path("out.palp"), "--kind", "relief"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean --as relief?"));
}

TEST_F(Notes, AReaderThatEndsEarlyIsNoError) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  // Standard output of the program is the pipe without a reader.
  const int kept = dup(STDOUT_FILENO);
  ASSERT_GE(dup2(ends[1], STDOUT_FILENO), 0);
  const std::string command = std::string(PALPABLE_PROGRAM) + " methods best 2>" + path("err.txt");
  const int status = std::system(command.c_str());
  dup2(kept, STDOUT_FILENO);
  for (const int end : {kept, ends[1]}) close(end);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(read_text(path("err.txt")), "");
}

TEST_F(Notes, TheSamplesNamesFitItHoweverItIsResampled) {
  for (const char* const samples : {"250", "33"}) {
    const Outcome outcome = palpable({"touch", "--headless", "--seconds", "0.2", "--method", "fast",
                                      "--resample", "bicubic", "--samples", samples});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
}

TEST_F(Notes, ATruncatedFileIsRefusedInPlainWords) {
  write_text(path("cut.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  const Outcome obj = palpable({"make", path("cut.obj"), "-o", path("out.palp")});
  EXPECT_EQ(obj.exit_code, 3);
  EXPECT_THAT(obj.err, HasSubstr("the face in line 4 names vertex 9 of 3"));
  std::string stl(84 + 50 * 3, '\0');
  stl[80] = 12;
  write_text(path("cut.stl"), stl);
  const Outcome cut = palpable({"make", path("cut.stl"), "-o", path("out.palp")});
  EXPECT_EQ(cut.exit_code, 3);
  EXPECT_THAT(cut.err, HasSubstr("it states 12 triangles"));
}

}  // namespace
}  // namespace palpable::test
