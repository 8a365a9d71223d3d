// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/formats/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "program.hpp"
#include "test_videos.hpp"
#include <gmock/gmock.h>

// Videos: small ones that are rendered here, a textured box on a textured table.
namespace palpable::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Videos : public InFolder {
 protected:
  /// A folder of pictures along an arc; returns its path.
  std::string video(int frames = 14, double from = -0.35, double step = 0.05) const {
    const std::filesystem::path to = folder_ / "video";
    std::filesystem::create_directories(to);
    for (int i = 0; i < frames; ++i)
      (void)formats::write_png(to / (std::to_string(100 + i) + ".png"),
                               picture_from(on_arc(from + step * i), {0, 0, 0.02}));
    write_text(path("camera.json"),
               R"({"fx": 220, "fy": 220, "cx": 119.5, "cy": 89.5, "width": 240, "height": 180})");
    return to.string();
  }
  std::vector<std::string> make(const std::string& input, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{
        "make",         input, "-o",    path("m.palp"),      "--calibration", path("camera.json"),
        "--resolution", "64",  "--set", "video.depth.maps=5"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(Videos, GiveEveryOutputTogether) {
  const std::string input = video();
  Running running(make(input, {"--poses", path("p.csv"), "--structure", path("s.ply"), "--depth-dir",
                               path("depth"), "--report", path("r.html"), "--mesh", path("m.glb"), "--length",
                               "100 mm between 98.8,87.6 and 140.2,87.6 of frame 7", "--json"}));
  // The report draws the solid, which takes a while.
  const Outcome made = running.wait(std::chrono::seconds(600));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(read_text(path("p.csv")), HasSubstr("frame,qw,qx,qy,qz,tx,ty,tz\n0,"));
  EXPECT_THAT(read_text(path("s.ply")).substr(0, 3), "ply");
  EXPECT_TRUE(std::filesystem::exists(path("depth") + "/depth.json"));
  EXPECT_THAT(read_text(path("m.glb")).substr(0, 4), "glTF");
  EXPECT_THAT(read_text(path("m.glb")), HasSubstr("TEXCOORD_0"));
  const std::string report = read_text(path("r.html"));
  EXPECT_THAT(report, HasSubstr("<h2>What to do better</h2>"));
  EXPECT_THAT(report, HasSubstr("The back was never seen"));
  for (const char* absent : {"Something moved", "are blurred"}) EXPECT_THAT(report, Not(HasSubstr(absent)));
  EXPECT_THAT(report, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(made.err, HasSubstr("The known length of 100.0 mm gives the scale."));
  // The scene keeps its metres: the box is 60 mm high.
  const auto size = made.json()["size_m"];
  EXPECT_GT(size[0], 0.11);
  EXPECT_LT(size[0], 0.3);
  EXPECT_NEAR(size[2].get<double>(), 0.07, 0.03);
}

TEST_F(Videos, UpToAFrameUseNoLaterOne) {
  const Outcome made = palpable(make(video(), {"--until", "8", "--poses", path("p.csv")}));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string poses = read_text(path("p.csv"));
  EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 1 + 9);
  EXPECT_THAT(poses, HasSubstr("\n8,"));
  EXPECT_THAT(poses, Not(HasSubstr("\n9,")));
}

// A patterned glove in front of a picture.
void add_glove(int left, int top, Raster<Rgb8>& picture) {
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 110; ++x)
      if (std::hypot((x - 55) / 55.0, (y - 45) / 45.0) < 1) {
        const auto level = static_cast<std::uint8_t>(40 + 200 * texture_at(0.0015 * x, 0.0015 * y, 9));
        picture(left + x, top + y) = {level, level, level};
      }
}

// Each pixel is the mean of those up to `half` pixels beside it.
Raster<Rgb8> blurred(const Raster<Rgb8>& sharp, int half) {
  Raster<Rgb8> out(sharp.width(), sharp.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      int sum = 0;
      for (int k = -half; k <= half; ++k) sum += sharp(std::clamp(x + k, 0, out.width() - 1), y).r;
      const auto level = static_cast<std::uint8_t>(sum / (2 * half + 1));
      out(x, y) = {level, level, level};
    }
  return out;
}

TEST_F(Videos, InWhichAHandMovesAndThatAreBlurredThroughoutSaySo) {
  constexpr int kFrames = 14, kBlur_px = 4;
  const std::filesystem::path input = video(kFrames);
  for (int i = 0; i < kFrames; ++i) {
    Raster<Rgb8> picture = picture_from(on_arc(-0.35 + 0.05 * i), {0, 0, 0.02});
    add_glove(4 + 4 * i, 4 + 3 * i, picture);
    (void)formats::write_png(input / (std::to_string(100 + i) + ".png"), blurred(picture, kBlur_px));
  }
  const Outcome made = palpable(make(input.string()));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("Something moved while you filmed, such as a hand"));
  EXPECT_THAT(made.err, HasSubstr("All pictures are blurred"));
}

TEST_F(Videos, WithoutDepthGetAReasonAndNothingIsWritten) {
  struct Case {
    int frames;
    double step;
    const char* says;
  };
  for (const Case& c : {Case{1, 0.0, "fewer than two pictures"}, Case{6, 0.0, "the camera did not move"}}) {
    std::filesystem::remove_all(folder_ / "video");
    const Outcome made = palpable(make(video(c.frames, 0.0, c.step), {"--report", path("r.html")}));
    EXPECT_EQ(made.exit_code, 3) << made.err;
    EXPECT_THAT(made.err, HasSubstr(c.says));
    EXPECT_TRUE(is_one_sentence(made.err)) << made.err;
    EXPECT_FALSE(std::filesystem::exists(path("m.palp")));
    EXPECT_FALSE(std::filesystem::exists(path("r.html")));
  }
}

TEST_F(Videos, OfOnePlainColourAskForTexture) {
  (void)video(0);
  const std::filesystem::path to = folder_ / "video";
  for (int i = 0; i < 5; ++i)
    (void)formats::write_png(to / (std::to_string(100 + i) + ".png"),
                             Raster<Rgb8>(kVideoWidth, kVideoHeight, Rgb8{235, 235, 235}));
  const Outcome made = palpable(make(to.string()));
  EXPECT_EQ(made.exit_code, 3) << made.err;
  EXPECT_THAT(made.err, HasSubstr("one plain colour"));
}

TEST_F(Videos, OfACameraThatOnlyTurnsSayThatItMustWalk) {
  const std::filesystem::path to = folder_ / "video";
  std::filesystem::create_directories(to);
  (void)video(0);
  for (int i = 0; i < 10; ++i)
    (void)formats::write_png(to / (std::to_string(100 + i) + ".png"),
                             picture_from(on_arc(0.0), {0.02 * i - 0.1, 0, 0.02}));
  const Outcome made = palpable(make(to.string()));
  EXPECT_EQ(made.exit_code, 3) << made.err;
  EXPECT_THAT(made.err, HasSubstr("the camera only turned"));
}

TEST_F(Videos, WithAWrongLengthAreRefusedBeforeAnyWork) {
  const std::string input = video(4);
  const Outcome words = palpable(make(input, {"--length", "long"}));
  EXPECT_EQ(words.exit_code, 2);
  EXPECT_THAT(words.err, HasSubstr("120 mm between"));
  const Outcome frame = palpable(make(input, {"--length", "120 mm between 1,2 and 3,4 of frame 99"}));
  EXPECT_EQ(frame.exit_code, 2) << frame.err;
  EXPECT_THAT(frame.err, HasSubstr("frame 99"));
}

TEST_F(Videos, ThatAreMissingAreSaidToBeMissingWhateverOutputIsNamed) {
  const Outcome missing = palpable(make(path("none.mp4"), {"--structure", path("s.ply")}));
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.err, HasSubstr("No such file"));
}

TEST_F(Videos, OfTinyPicturesAreRefused) {
  const std::filesystem::path folder = path("tiny");
  std::filesystem::create_directory(folder);
  for (int k = 0; k < 10; ++k) std::ofstream(folder / (std::to_string(k) + ".ppm")) << "P6 1 1 255\nabc";
  const Outcome tiny = palpable(make(folder.string()));
  EXPECT_EQ(tiny.exit_code, 3);
  EXPECT_THAT(tiny.err, HasSubstr("1 x 1"));
}

TEST_F(Videos, EndAtOnceWhenInterrupted) {
  const std::vector<std::string> words{"make",          video(40, -0.4, 0.02), "-o",       path("m.palp"),
                                       "--calibration", path("camera.json"),   "--report", path("r.html"),
                                       "--set",         "video.depth.maps=38"};
  Running running(words);
  ASSERT_TRUE(running.catches(SIGINT, std::chrono::seconds(60)));
  ASSERT_TRUE(running.works(std::chrono::seconds(1), std::chrono::seconds(60)));
  running.send(SIGINT);
  EXPECT_EQ(running.wait().exit_code, 130);
  EXPECT_FALSE(std::filesystem::exists(path("m.palp")));
  EXPECT_FALSE(std::filesystem::exists(path("r.html")));
}

TEST_F(Videos, HaveMarkerSheetsAsSvgPdfAndPng) {
  const Outcome sheet = palpable({"marker", "-o", path("sheet.svg"), "--side", "80"});
  ASSERT_EQ(sheet.exit_code, 0) << sheet.err;
  EXPECT_THAT(read_text(path("sheet.svg")), HasSubstr("<svg"));
  EXPECT_EQ(palpable({"marker", "-o", path("sheet.pdf")}).exit_code, 0);
  EXPECT_EQ(palpable({"marker", "-o", path("sheet.png")}).exit_code, 0);
  const Outcome refused = palpable({"marker", "-o", path("other.svg"), "--side", "70"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("30, 40, 50, 60, 80, 100, 120, 150"));
}

}  // namespace
}  // namespace palpable::test
