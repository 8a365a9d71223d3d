// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"

#include <cmath>
#include <fstream>
#include <utility>
#include <vector>

#include "program.hpp"
#include <gmock/gmock.h>
#include <sys/stat.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;

/// A depth map of a ball in front of a wall, in millimetres (16-bit PNG).
Raster<std::uint16_t> ball_mm() {
  Raster<std::uint16_t> depth(80, 60, 1000);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x)
      if (const double r2 = std::pow(x - 40, 2) + std::pow(y - 30, 2); r2 < 400.0)
        depth(x, y) = static_cast<std::uint16_t>(900 - 5 * std::sqrt(400.0 - r2));
  return depth;
}

class Materials : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write(ball_mm());
  }
  void write(const Raster<std::uint16_t>& depth) const {
    ASSERT_TRUE(formats::write_png(path("depth.png"), depth));
  }
  Outcome make(std::vector<std::string> more) const {
    std::vector<std::string> all{"make", path("depth.png"), "--kind", "depth",
                                 "-o",   path("a.palp"),    "--json", "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return palpable(all);
  }
  void expect_refused(const Outcome& outcome, int exit_code, const std::string& about) const {
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_TRUE(is_one_sentence(outcome.err));
    EXPECT_THAT(outcome.err, HasSubstr(about));
    EXPECT_FALSE(std::filesystem::exists(path("a.palp")));
  }
};

TEST_F(Materials, AStiffnessOutOfRangeIsRefusedWithItsRange) {
  for (const char* wrong : {"0", "1e9", "-5", "nan"}) {
    expect_refused(make({"--material", std::string("0:stiffness=") + wrong}), 2, "stiffness must be");
    const auto probed = palpable({"touch", path("depth.png"), "--kind", "depth", "--headless", "--quiet",
                                  "--seconds", "0.1", "--stiffness", wrong});
    EXPECT_EQ(probed.exit_code, 2) << wrong;
    EXPECT_TRUE(is_one_sentence(probed.err));
  }
}

TEST_F(Materials, APropertyGivenTwiceOrANameThatActsOnATerminalIsRefused) {
  expect_refused(make({"--material", "0:friction=0.2", "--material", "0:friction=0.4"}), 2,
                 "friction of label 0 is given more than once");
  expect_refused(make({"--material", "0:friction=0.2,friction=0.4"}), 2, "more than once");
  expect_refused(make({"--material", "0:name=a\x1B[31mb"}), 2, "control characters");
  expect_refused(make({"--material", "0:name=a\nb"}), 2, "control characters");
  expect_refused(make({"--material", "0:name="}), 2, "name is empty");
  expect_refused(make({"--material", "0:name=" + std::string(401, 'x')}), 2, "at most 400 bytes");
  expect_refused(make({"--material", "0:name=caf\xE9"}), 2, "not UTF-8");
}

TEST_F(Materials, LabelsAndTexturesMayComeFromPipes) {
  Raster<std::uint8_t> labels(80, 60, 0), waves(80, 60, 0);
  labels(3, 4) = 1;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) waves(x, y) = static_cast<std::uint8_t>(100 + 100 * (x / 8 % 2));
  ASSERT_TRUE(formats::write_png(path("labels.png"), labels));
  ASSERT_TRUE(formats::write_png(path("waves.png"), waves));
  const std::string pipe = path("pipe.png");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  using Words = std::vector<std::string>;
  for (const auto& [picture, use] :
       {std::pair("labels.png", Words{"--material", "1:name=box", "--labels", pipe}),
        std::pair("waves.png", Words{"--material", "0:texture=" + pipe + ",size=20"})}) {
    Words all{"make", path("depth.png"), "--kind", "depth", "-o", path("a.palp")};
    all.insert(all.end(), use.begin(), use.end());
    Running running(all);
    // Waits until the program opens it.
    std::ofstream(pipe, std::ios::binary) << read_text(path(picture));
    const Outcome outcome = running.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
}

TEST_F(Materials, ALabelPictureMustHaveTheAspectRatioButMayHaveAnotherSize) {
  ASSERT_TRUE(formats::write_png(path("wrong.png"), Raster<std::uint8_t>(80, 40, 0)));
  expect_refused(make({"--labels", path("wrong.png")}), 3, "80x40");
  ASSERT_TRUE(formats::write_png(path("half.png"), Raster<std::uint8_t>(40, 30, 0)));
  EXPECT_EQ(make({"--labels", path("half.png")}).exit_code, 0);
}

TEST_F(Materials, ALabelWithoutAMaterialIsRefused) {
  ASSERT_TRUE(formats::write_png(path("labels.png"), Raster<std::uint8_t>(80, 60, 3)));
  expect_refused(make({"--labels", path("labels.png"), "--material", "1:friction=0.1"}), 3, "material 3");
}

TEST_F(Materials, ATextureTooFineForTheServoIsOmittedWithAMessage) {
  ASSERT_EQ(make({"--material", "0:texture=ridges,pitch=0.2"}).exit_code, 0);
  EXPECT_THAT(palpable({"info", path("a.palp")}).out, HasSubstr("texture ridges every 0.2 mm"));
  const auto touched = palpable({"touch", path("a.palp"), "--headless", "--seconds", "0.2", "--json"});
  EXPECT_EQ(touched.exit_code, 0);
  EXPECT_THAT(touched.err, HasSubstr("left out"));
}

TEST_F(Materials, ATextureIsReadFromAHeightPicture) {
  Raster<std::uint8_t> waves(128, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) waves(x, y) = static_cast<std::uint8_t>((x / 16) % 2 == 0 ? 40 : 200);
  ASSERT_TRUE(formats::write_png(path("waves.png"), waves));
  ASSERT_EQ(make({"--material", "0:texture=" + path("waves.png") + ",size=24,height=0.03"}).exit_code, 0);
  const auto told = palpable({"info", path("a.palp"), "--json"});
  EXPECT_THAT(told.out, HasSubstr("\"kind\":\"picture\""));
  EXPECT_THAT(told.out, HasSubstr("\"pitch_m\":0.002"));
  EXPECT_THAT(palpable({"info", path("a.palp")}).out,
              HasSubstr("texture of a picture, 24 mm wide, 30 um high"));
  const auto touched = palpable({"touch", path("a.palp"), "--headless", "--seconds", "0.2", "--json"});
  EXPECT_EQ(touched.exit_code, 0);
  EXPECT_THAT(touched.err, Not(HasSubstr("texture")));
}

TEST_F(Materials, ATexturesPictureThatIsMissingOrOfOneToneIsRefused) {
  expect_refused(make({"--material", "0:texture=" + path("none.png")}), 3, "none.png");
  ASSERT_TRUE(formats::write_png(path("plain.png"), Raster<std::uint8_t>(64, 64, 90)));
  expect_refused(make({"--material", "0:texture=" + path("plain.png")}), 3, "one tone");
  expect_refused(make({"--material", "0:texture=picture"}), 2, "file name");
}

TEST_F(Materials, ATextureOnAFieldIsFelt) {
  write_text(path("box.obj"),
             "v 0 0 0\nv 0.02 0 0\nv 0.02 0.02 0\nv 0 0.02 0\nv 0 0 0.02\nv 0.02 0 0.02\nv 0.02 0.02 0.02\n"
             "v 0 0.02 0.02\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const auto made = palpable(
      {"make", path("box.obj"), "-o", path("a.palp"), "--resolution", "16", "--material", "0:texture=grain"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto touched = palpable({"touch", path("a.palp"), "--headless", "--seconds", "0.2", "--json"});
  EXPECT_EQ(touched.exit_code, 0);
  EXPECT_THAT(touched.err, Not(HasSubstr("texture")));
}

TEST_F(Materials, DepthWithHolesOneLevelOrAnOutlierMakesARelief) {
  const auto ball = ball_mm();
  auto holes = ball;
  for (std::size_t k = 0; k < holes.count(); ++k)
    if (k % 5 != 0) holes.values()[k] = 0;
  auto spike = ball;
  spike(10, 10) = 65535;
  auto stripes = ball;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x)
      if (x % 3 == 0) stripes(x, y) = static_cast<std::uint16_t>(500 + (x * 7919 + y * 104729) % 1000);
  const Raster<std::uint16_t> one_level(80, 60, 700);
  for (const Raster<std::uint16_t>* depth :
       {&std::as_const(holes), &std::as_const(spike), &std::as_const(stripes), &one_level}) {
    write(*depth);
    ASSERT_EQ(make({}).exit_code, 0);
    const auto info = palpable({"info", path("a.palp"), "--json"}).json();
    EXPECT_TRUE(std::isfinite(info["size_m"][2].get<double>()));
    EXPECT_LE(info["size_m"][2].get<double>(), 0.015 + 1e-9);
  }
  EXPECT_EQ(make({"--depth-scale", "1000"}).exit_code, 0) << "a level 700 km away";
}

TEST_F(Materials, DepthIsResampledOnRequest) {
  for (const char* how : {"bilinear", "bicubic"}) {
    ASSERT_EQ(make({"--resample", how, "--samples", "200"}).exit_code, 0);
    ASSERT_EQ(palpable({"export", path("a.palp"), "-o", path("a.png")}).exit_code, 0);
    const auto info = palpable({"info", path("a.palp"), "--json"}).json();
    EXPECT_NEAR(info["size_m"][0].get<double>(), 0.1, 1e-9);
    EXPECT_GT(info["memory_bytes"].get<double>(), 200 * 150 * 4.0 - 1);
  }
  EXPECT_EQ(make({"--resample", "cubic"}).exit_code, 2);
}

TEST(Studies, OfTrajectoriesAndTracingPrintJson) {
  const auto trajectories = palpable({"study-trajectories", "--trajectories", "200", "--json"}).json();
  EXPECT_EQ(trajectories["trajectories"], 200);
  EXPECT_EQ(trajectories["let_through"], 0);
  const auto tracing = palpable({"study-tracing", "--tracers", "1", "--repeats", "1", "--json"}).json();
  EXPECT_EQ(tracing["simulation"], true);
  EXPECT_EQ(tracing["figures"].size(), 3U);
  EXPECT_EQ(tracing["figures"][0]["people"]["seconds"][0], 26.12);
}

TEST_F(Materials, FrictionSetsSlidingToFiveSixthsByDefault) {
  const auto sliding = [&](const char* material) {
    EXPECT_EQ(make({"--material", material}).exit_code, 0);
    return palpable({"info", path("a.palp"), "--json"})
        .json()["materials"][0]["dynamic_friction"]
        .get<double>();
  };
  EXPECT_DOUBLE_EQ(sliding("0:friction=0.6"), 0.5);
  EXPECT_DOUBLE_EQ(sliding("0:friction=0.6,sliding=0.2"), 0.2);
  EXPECT_DOUBLE_EQ(sliding("0:sliding=0.2,friction=0.6"), 0.2);
}

TEST_F(Materials, AnUnknownKeyListsTheKeys) {
  expect_refused(
      make({"--material", "0:shine=1"}), 2,
      "its keys are name, texture, stiffness, damping, friction, sliding, pitch, size, height, angle");
}

}  // namespace
}  // namespace palpable::test
