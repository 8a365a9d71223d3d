// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "program.hpp"
#include "test_pictures.hpp"
#include <gmock/gmock.h>

// Realistic bad pairs: each gets a message with a figure that shows the problem, and the best possible depth.
namespace palpable::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class BadPairs : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    pair_ = textured_pair(320, 240);
  }
  /// Runs `depth` on the pair, which must succeed.
  Outcome depth(const Raster<Rgb8>& left, const Raster<Rgb8>& right, std::vector<std::string> options = {}) {
    EXPECT_TRUE(formats::write_png(path("left.png"), left) && formats::write_png(path("right.png"), right));
    std::vector<std::string> words{"depth", path("left.png"), path("right.png"),
                                   "-o",    path("d.pfm"),    "--json"};
    if (std::find(options.begin(), options.end(), "--method") == options.end())
      options.insert(options.end(), {"--method", "fast"});
    words.insert(words.end(), options.begin(), options.end());
    Outcome outcome = palpable(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const auto& note : outcome.json()["notes"])
      EXPECT_THAT(outcome.err, HasSubstr(note.get<std::string>()));
    return outcome;
  }
  /// Percent of pixels of depth()'s output with an error above `px`.
  double bad_percent(const Raster<float>& truth_px, const char* px,
                     const std::vector<std::string>& mask = {}) {
    EXPECT_TRUE(formats::write_disparity_pfm(path("truth.pfm"), truth_px));
    std::vector<std::string> words{"score", "disparity", path("d.pfm"), path("truth.pfm"), "--json"};
    words.insert(words.end(), mask.begin(), mask.end());
    return palpable(words).json()["bad"][px].get<double>();
  }
  Outcome fit() { return palpable({"fit", path("left.png"), path("right.png"), "--json"}); }
  Pair pair_;
};

template <class Map>
Raster<Rgb8> levelled(const Raster<Rgb8>& picture, const Map& map) {
  Raster<Rgb8> out = picture;
  const auto level = [&map](std::uint8_t v) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(map(static_cast<double>(v)), 0.0, 255.0)));
  };
  for (Rgb8& p : out.values()) p = {level(p.r), level(p.g), level(p.b)};
  return out;
}

/// The picture resampled bilinearly at place(x, y).
template <class Place>
Raster<Rgb8> moved(const Raster<Rgb8>& picture, const Place& place) {
  Raster<Rgb8> out = picture;
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const auto [u, v] = place(x, y);
      const double a = std::clamp(u, 0.0, out.width() - 1.001), b = std::clamp(v, 0.0, out.height() - 1.001);
      const int i = static_cast<int>(a), j = static_cast<int>(b);
      const double s = a - i, t = b - j;
      const auto blend = [&](auto channel) {
        const auto at = [&](int k, int l) { return static_cast<double>(picture(k, l).*channel); };
        return static_cast<std::uint8_t>(std::lround((1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) +
                                                     t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1))));
      };
      out(x, y) = {blend(&Rgb8::r), blend(&Rgb8::g), blend(&Rgb8::b)};
    }
  return out;
}

template <class T>
Raster<T> columns(const Raster<T>& whole, int from, int count) {
  Raster<T> out(count, whole.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < count; ++x) out(x, y) = whole(from + x, y);
  return out;
}

TEST_F(BadPairs, WithoutOverlapShowLittleAgreementAndAreHardlyFit) {
  const Outcome apart = depth(columns(pair_.left, 0, 150), columns(pair_.left, 170, 150));
  EXPECT_THAT(apart.err, AllOf(HasSubstr("little agreement"), HasSubstr("%")));
  EXPECT_THAT(apart.err, Not(HasSubstr("exposed differently"))) << "exposure cannot be compared";
  EXPECT_THAT(fit().json()["sentence"].get<std::string>(), HasSubstr("hardly fit"));
}

TEST_F(BadPairs, OfAPlainWallWithCameraNoiseHaveNoTexture) {
  std::mt19937 random(4);
  std::normal_distribution<double> grain(128.0, 3.0);
  const auto wall = [&] {
    Raster<Rgb8> out(320, 240);
    for (Rgb8& p : out.values()) {
      const auto v = static_cast<std::uint8_t>(std::lround(grain(random)));
      p = {v, v, v};
    }
    return out;
  };
  const Raster<Rgb8> left = wall();
  EXPECT_THAT(depth(left, wall()).err,
              AllOf(HasSubstr("grain"), HasSubstr("%"), HasSubstr("light the scene")));
  const auto judged = fit().json();
  EXPECT_LT(judged["textured"], 0.1);
  EXPECT_THAT(judged["sentence"].get<std::string>(), HasSubstr("no texture"));
}

TEST_F(BadPairs, ExchangedAreMatchedAndReported) {
  const Outcome swapped = depth(pair_.right, pair_.left);
  EXPECT_THAT(swapped.err,
              AllOf(HasSubstr("exchanged"), HasSubstr("(disparities from -1"), HasSubstr("pixels")));
  EXPECT_GT(fit().json()["agreement"], 0.8);
}

TEST_F(BadPairs, ExposedDifferentlyLoseLittleEvenIfOneIsOverexposed) {
  for (const auto& [method, gain] : {std::pair{"fast", 0.4}, {"scanline", 1.5}, {"graph-cut", 1.5}}) {
    depth(pair_.left, pair_.right, {"--method", method});
    const double equal = bad_percent(pair_.disparity_px, "1");
    const Raster<Rgb8> unlike = levelled(pair_.right, [k = gain](double v) { return k * v; });
    EXPECT_THAT(depth(pair_.left, unlike, {"--method", method}).err, HasSubstr("times as bright"));
    EXPECT_LT(bad_percent(pair_.disparity_px, "1"), equal + 1.5) << method;
  }
  const Outcome burnt = depth(pair_.left, levelled(pair_.right, [](double v) { return 2.2 * v; }));
  EXPECT_THAT(burnt.err, AllOf(HasSubstr("% of the right one is burnt out"), HasSubstr("the same exposure")));
}

TEST_F(BadPairs, WithRollingOffsetsAreRectified) {
  depth(pair_.left, pair_.right);
  const double still = bad_percent(pair_.disparity_px, "2");
  const auto roll = [](double place) { return 4.0 * std::sin(2.0 * std::numbers::pi * place); };
  for (const bool down : {true, false}) {
    const Raster<Rgb8> right = moved(pair_.right, [&](int x, int y) {
      return std::pair(1.0 * x, y + roll(down ? y / 240.0 : x / 320.0));
    });
    const Outcome rolling = depth(pair_.left, right);
    EXPECT_THAT(rolling.err,
                AllOf(HasSubstr("are displaced vertically by up to"), HasSubstr("were rectified")));
    EXPECT_LT(bad_percent(pair_.disparity_px, "2"), still + 4.0) << (down ? "down" : "across");
  }
}

TEST_F(BadPairs, WithDisparitiesOfHalfTheWidthAreMatched) {
  constexpr int kWidth = 210, kFarther = 92;
  Raster<float> truth_px = columns(pair_.disparity_px, 0, kWidth);
  Raster<std::uint8_t> seen(kWidth, 240);
  for (int y = 0; y < seen.height(); ++y)
    for (int x = 0; x < kWidth; ++x) {
      truth_px(x, y) += kFarther;
      seen(x, y) = static_cast<float>(x) > truth_px(x, y) + 14.0F ? 255 : 0;
    }
  ASSERT_TRUE(formats::write_png(path("seen.png"), seen));
  depth(columns(pair_.left, 0, kWidth), columns(pair_.right, kFarther, kWidth));
  EXPECT_LT(bad_percent(truth_px, "2", {"--mask", path("seen.png")}), 12.0);
  EXPECT_THAT(fit().json()["sentence"].get<std::string>(), HasSubstr("only one picture shows it"));
}

TEST_F(BadPairs, UseACalibrationOfTheSameAspectRatioOnly) {
  const auto calibration = [&](int width, int height) {
    write_text(path("c.json"), "{\"fx\": 600, \"fy\": 600, \"cx\": " + std::to_string(width / 2) +
                                   ", \"cy\": " + std::to_string(height / 2) +
                                   ", \"width\": " + std::to_string(width) +
                                   ", \"height\": " + std::to_string(height) + ", \"baseline_m\": 0.1}");
    return std::vector<std::string>{"--calibration", path("c.json")};
  };
  EXPECT_THAT(depth(pair_.left, pair_.right, calibration(640, 480)).err,
              HasSubstr("The calibration is for 640 x 480 pixels; it was scaled to 320 x 240."));
  calibration(640, 360);
  std::filesystem::remove(path("d.pfm"));
  const Outcome other = palpable(
      {"depth", path("left.png"), path("right.png"), "-o", path("d.pfm"), "--calibration", path("c.json")});
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_TRUE(is_one_sentence(other.err));
  EXPECT_THAT(other.err, AllOf(HasSubstr("c.json"), HasSubstr("640 x 360"), HasSubstr("320 x 240")));
  EXPECT_FALSE(std::filesystem::exists(path("d.pfm")));
}

TEST_F(BadPairs, OfACameraThatOnlyTurnedAreReportedWithoutDepth) {
  const double c = std::cos(0.05), s = std::sin(0.05);
  const Raster<Rgb8> turned = moved(pair_.left, [&](int x, int y) {
    return std::pair(170.0 + c * (x - 160) - s * (y - 120), 116.0 + s * (x - 160) + c * (y - 120));
  });
  const Outcome still = depth(pair_.left, turned, {"--moved", "50"});
  EXPECT_THAT(still.err, AllOf(HasSubstr("hardly moved"), HasSubstr("pixels (RMS) beyond what a rotation")));
}

}  // namespace
}  // namespace palpable::test
