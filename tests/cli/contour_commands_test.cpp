// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/picture/picture.hpp"

#include <cmath>
#include <random>

#include "program.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Unsuitable pictures made into contours.
class ContourInput : public InFolder {
 protected:
  Outcome make() const {
    return palpable({"make", path("a.png"), "-o", path("a.palp"), "--as", "contours", "--json"});
  }
  std::string read(const std::string& name) const {
    const auto file = read_file(path(name));
    return file ? std::string(as_text(*file)) : std::string();
  }
  double boundary_fraction() const {
    return palpable({"info", path("a.palp"), "--json"}).json()["boundary_fraction"].get<double>();
  }
};

TEST_F(ContourInput, OfOneColourHasNoBoundaryAndCanBeTouched) {
  ASSERT_TRUE(formats::write_png(path("a.png"), Raster<std::uint8_t>(120, 90, 128)));
  ASSERT_EQ(make().exit_code, 0);
  EXPECT_EQ(boundary_fraction(), 0.0);
  const auto touched = palpable({"touch", path("a.palp"), "--headless", "--seconds", "0.2", "--json"});
  EXPECT_EQ(touched.exit_code, 0) << touched.err;
}

TEST_F(ContourInput, OfPureNoiseGivesAFiniteForce) {
  std::mt19937 random(1);
  Raster<std::uint8_t> noise(120, 90);
  for (auto& v : noise.values()) v = static_cast<std::uint8_t>(random() & 0xFFU);
  ASSERT_TRUE(formats::write_png(path("a.png"), noise));
  ASSERT_EQ(make().exit_code, 0);
  const auto touched = palpable({"touch", path("a.palp"), "--headless", "--seconds", "0.3", "--json"}).json();
  EXPECT_TRUE(std::isfinite(touched["force"]["max_N"].get<double>()));
}

TEST_F(ContourInput, OfSixteenBitsInANarrowRangeHasBoundaries) {
  // A scanner's values: 1000 to 1100 of 65535.
  Raster<std::uint16_t> scan(120, 90, 1000);
  for (int y = 30; y < 60; ++y)
    for (int x = 40; x < 80; ++x) scan(x, y) = 1100;
  ASSERT_TRUE(formats::write_png(path("a.png"), scan));
  ASSERT_EQ(make().exit_code, 0);
  EXPECT_GT(boundary_fraction(), 0.01);
  EXPECT_LT(boundary_fraction(), 0.2);
}

TEST_F(ContourInput, IsExportedForSwellPaperEmbossersAndPrinters) {
  Raster<std::uint8_t> disc(160, 120, 255);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x)
      if (std::hypot(x - 80, y - 60) < 40) disc(x, y) = 0;
  ASSERT_TRUE(formats::write_png(path("a.png"), disc));
  const Outcome made = make();
  ASSERT_EQ(made.exit_code, 0);
  // The grooves are 1.5 mm deep, which is the scene's stated height.
  EXPECT_NEAR(palpable({"info", path("a.palp"), "--json"}).json()["size_m"][2].get<double>(), 0.0015, 1e-4);
  for (const char* ending : {"svg", "brf", "pbm", "stl"})
    ASSERT_EQ(palpable({"export", path("a.palp"), "-o", path(std::string("a.") + ending)}).exit_code, 0)
        << ending;
  const std::string svg = read("a.svg");
  EXPECT_THAT(svg, AllOf(HasSubstr("width=\"100.000mm\""), HasSubstr("Z\"/>")));
  // A disc half as wide as the page: dots in the middle rows, none in the first.
  const std::string brf = read("a.brf");
  EXPECT_THAT(brf, AllOf(HasSubstr("C"), ::testing::StartsWith("\r\n"), ::testing::EndsWith("\f")));
  // The same on 60 x 40 pins.
  EXPECT_THAT(read("a.pbm"), AllOf(::testing::StartsWith("P1\n60 40\n00000"), HasSubstr("11")));
  ASSERT_EQ(palpable({"export", path("a.palp"), "-o", path("raised.stl"), "--lines", "raised"}).exit_code, 0);
  EXPECT_NE(read("raised.stl"), read("a.stl"));
  // As a picture of the lines, with its scale beside it: 160 px are 100 mm.
  const Outcome picture = palpable({"export", path("a.palp"), "-o", path("lines.png")});
  ASSERT_EQ(picture.exit_code, 0);
  EXPECT_THAT(picture.out, HasSubstr("0.625 mm a pixel"));
  const auto scale = nlohmann::json::parse(read("lines.png.json"), nullptr, false);
  EXPECT_NEAR(scale["pixel_m"].get<double>(), 0.000625, 1e-9);
  EXPECT_NEAR(scale["strength_per_step"].get<double>(), 1.0 / 65535.0, 1e-12);
  const Outcome wrong = palpable({"export", path("a.palp"), "-o", path("a.vdb")});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr(".brf"));
}

TEST_F(ContourInput, OfOnePixelLinesHasAJunctionWhereTheyCross) {
  Raster<std::uint8_t> lines(160, 120, 255);
  for (int x = 20; x < 140; ++x) lines(x, 60) = 0;
  for (int y = 20; y < 100; ++y) lines(80, y) = 0;
  ASSERT_TRUE(formats::write_png(path("a.png"), lines));
  ASSERT_EQ(make().exit_code, 0);
  const auto materials = palpable({"info", path("a.palp"), "--json"}).json()["materials"];
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(materials[1]["name"], "junction");
}

TEST_F(ContourInput, OfTooManyPixelsIsReducedWithAMessage) {
  Raster<std::uint8_t> scan(2400, 1800, 200);
  for (int y = 600; y < 1200; ++y)
    for (int x = 800; x < 1600; ++x) scan(x, y) = 20;
  ASSERT_TRUE(formats::write_png(path("a.png"), scan));
  const auto made = make();
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out + made.err, HasSubstr("reduced from 2400 x 1800 to 2364 x 1773 pixels"));
  EXPECT_GT(boundary_fraction(), 0.001);
}

TEST_F(ContourInput, ThatIsTransparentIsCompositedOnWhite) {
  Image drawing;
  drawing.width = 100;
  drawing.height = 80;
  drawing.channels = 4;
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 100; ++x) {
      const bool inside = std::hypot(x - 50, y - 40) < 20;
      // Black everywhere; only the disc is opaque.
      drawing.samples.insert(drawing.samples.end(), {0.0F, 0.0F, 0.0F, inside ? 1.0F : 0.0F});
    }
  ASSERT_TRUE(formats::write_png(path("a.png"), drawing));
  ASSERT_EQ(make().exit_code, 0);
  EXPECT_GT(boundary_fraction(), 0.01);
}

}  // namespace
}  // namespace palpable::test
