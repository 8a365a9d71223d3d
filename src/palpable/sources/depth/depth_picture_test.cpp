// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/depth_picture.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/sources/picture/made_files.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace palpable::sources {
namespace {

namespace fs = std::filesystem;

class ADepthPicture : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("palpable-dp-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void text(const std::string& name, std::string_view content) const {
    ASSERT_TRUE(write_file_atomically(folder_ / name, as_bytes(content)));
  }
  Result<DepthPicture> read(const std::string& name, const DepthSettings& settings = {}) const {
    return read_depth_picture(std::vector{folder_ / name}, settings);
  }
  fs::path folder_;
};

float metres(const Result<DepthPicture>& picture, int x, int y) {
  return std::get<DepthMap>(picture->depth).depth_m(x, y);
}
float disparity(const Result<DepthPicture>& picture, int x, int y) {
  return std::get<DisparityMap>(picture->depth).disparity_px(x, y);
}

Raster<std::uint16_t> sixteen_bit() {
  Raster<std::uint16_t> values(8, 6, 1500);
  values(0, 0) = 0;
  values(1, 0) = 65535;
  return values;
}

TEST_F(ADepthPicture, OfSixteenBitsIsMillimetresUnlessStatedOtherwise) {
  ASSERT_TRUE(formats::write_png(folder_ / "d.png", sixteen_bit()));
  const auto assumed = read("d.png");
  ASSERT_TRUE(assumed) << assumed.error().sentence();
  EXPECT_FLOAT_EQ(metres(assumed, 3, 3), 1.5F);
  EXPECT_EQ(assumed->unknown, 1U);
  EXPECT_EQ(assumed->notes.size(), 1U) << "what is assumed is said";

  DepthSettings stated;
  stated.metres_per_unit = 1.0 / 5000;
  const auto scaled = read("d.png", stated);
  EXPECT_FLOAT_EQ(metres(scaled, 3, 3), 0.3F);
  EXPECT_TRUE(scaled->notes.empty());
}

TEST_F(ADepthPicture, ObeysOptionsBeforeItsSidecar) {
  ASSERT_TRUE(formats::write_png(folder_ / "d.png", sixteen_bit()));
  text("depth.json", R"({"metres_per_unit": 0.0001})");
  EXPECT_FLOAT_EQ(metres(read("d.png"), 3, 3), 0.15F);
  text("d.json",
       R"({"metres_per_unit": 0.01, "fx": 8, "fy": 8, "cx": 3.5, "cy": 2.5, "width": 8, "height": 6})");
  const auto own = read("d.png");
  EXPECT_FLOAT_EQ(metres(own, 3, 3), 15.0F) << "the file's own sidecar comes before the folder's";
  EXPECT_EQ(std::get<DepthMap>(own->depth).camera, (Pinhole{8, 8, 3.5, 2.5, 8, 6}));
  DepthSettings option;
  option.metres_per_unit = 1.0;
  EXPECT_FLOAT_EQ(metres(read("d.png", option), 3, 3), 1500.0F);
  text("d.json",
       R"({"metres_per_unit": 0.01, "fx": 8, "fy": 8, "cx": 3.5, "cy": 2.5, "width": 80, "height": 60})");
  const auto wrong = read("d.png");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("camera is stated for 80 x 60"), std::string::npos);
}

TEST_F(ADepthPicture, WithADamagedSidecarIsRefusedNamingIt) {
  ASSERT_TRUE(formats::write_png(folder_ / "d.png", sixteen_bit()));
  for (const char* json :
       {"", "{", "[]", R"({"meaning":"wish"})", R"({"meaning":1})", R"({"metres_per_unit":0})",
        R"({"metres_per_unit":"1"})", R"({"near_m":"x"})", R"({"near_m":1,"range":"2..3"})", R"({"fx":1})",
        R"({"colour":3})", R"({"colour":{"fx":1}})"}) {
    text("d.png.json", json);
    const auto picture = read("d.png");
    ASSERT_FALSE(picture) << json;
    EXPECT_NE(picture.error().sentence().find("d.png.json: "), std::string::npos)
        << picture.error().sentence();
    EXPECT_EQ(picture.error().code, ErrorCode::invalid_input);
  }
}

TEST_F(ADepthPicture, OfADepthBufferNeedsItsPlanes) {
  Raster<std::uint16_t> buffer(4, 4, 65535);
  constexpr double kNear = 0.5;
  constexpr double kFar = 20.0;
  buffer(1, 1) = static_cast<std::uint16_t>(std::lround(65535 * kFar / (kFar - kNear) * (1.0 - kNear / 2.0)));
  ASSERT_TRUE(formats::write_png(folder_ / "z.png", buffer));
  text("z.json", R"({"meaning": "zbuffer", "near_m": 0.5, "far_m": 20})");
  const auto picture = read("z.png");
  ASSERT_TRUE(picture) << picture.error().sentence();
  EXPECT_NEAR(metres(picture, 1, 1), 2.0, 2e-4);
  EXPECT_EQ(picture->unknown, 15U) << "what was never drawn on";
  text("z.json", R"({"meaning": "zbuffer"})");
  const auto refused = read("z.png");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("near and far planes"), std::string::npos);
}

TEST_F(ADepthPicture, MayLieInAPicturesAlpha) {
  Image image{2, 1, 4, 8, {1.0F, 0.0F, 0.0F, 51.0F / 255, 0.0F, 1.0F, 0.0F, 1.0F}};
  ASSERT_TRUE(formats::write_png(folder_ / "a.png", image));
  const auto picture = read("a.png");
  ASSERT_TRUE(picture) << picture.error().sentence();
  EXPECT_FLOAT_EQ(disparity(picture, 0, 0), 51.0F);
  EXPECT_FLOAT_EQ(disparity(picture, 1, 0), 255.0F);
  ASSERT_TRUE(picture->colour);
  EXPECT_EQ(picture->colour->channels, 3);
  EXPECT_EQ(picture->colour->pixel(1, 0)[1], 1.0F);
  DepthSettings millimetres;
  millimetres.metres_per_unit = 0.001;
  EXPECT_FLOAT_EQ(metres(read("a.png", millimetres), 1, 0), 0.255F);
}

TEST_F(ADepthPicture, OfEightBitsIsNearness) {
  Raster<std::uint8_t> grey(2, 1);
  grey(1, 0) = 200;
  ASSERT_TRUE(formats::write_png(folder_ / "g.png", grey));
  const auto picture = read("g.png");
  ASSERT_TRUE(picture);
  EXPECT_FLOAT_EQ(disparity(picture, 0, 0), 0.0F);
  EXPECT_FLOAT_EQ(disparity(picture, 1, 0), 200.0F);
  EXPECT_EQ(picture->notes.size(), 1U);
}

TEST_F(ADepthPicture, OfDistancesAlongTheRaysBecomesDepth) {
  const Pinhole camera{4.0, 4.0, 1.0, 0.0, 5, 1};
  Raster<float> lengths(5, 1);
  for (int x = 0; x < 5; ++x)
    lengths(x, 0) = static_cast<float>(2.0 * std::sqrt(1.0 + (x - 1) * (x - 1) / 16.0));
  ASSERT_TRUE(formats::write_pfm(folder_ / "r.pfm", lengths));
  DepthSettings settings;
  settings.meaning = DepthMeaning::distance;
  EXPECT_EQ(read("r.pfm", settings).error().code, ErrorCode::usage);
  settings.camera = camera;
  const auto picture = read("r.pfm", settings);
  ASSERT_TRUE(picture);
  for (int x = 0; x < 5; ++x) EXPECT_FLOAT_EQ(metres(picture, x, 0), 2.0F);
}

TEST_F(ADepthPicture, WithItsColourPictureFitsItOrSaysWhyNot) {
  ASSERT_TRUE(formats::write_png(folder_ / "d.png", sixteen_bit()));
  ASSERT_TRUE(formats::write_png(folder_ / "same.png", Raster<Rgb8>(8, 6, {9, 8, 7})));
  ASSERT_TRUE(formats::write_png(folder_ / "twice.png", Raster<Rgb8>(16, 12, {9, 8, 7})));
  ASSERT_TRUE(formats::write_png(folder_ / "other.png", Raster<Rgb8>(8, 8, {9, 8, 7})));
  for (const char* name : {"same.png", "twice.png"}) {
    const auto picture = read_depth_picture(std::vector{folder_ / name, folder_ / "d.png"});
    ASSERT_TRUE(picture) << picture.error().sentence();
    EXPECT_EQ(picture->colour->width, 8);
    EXPECT_EQ(rgb8(*picture->colour)(7, 5), (Rgb8{9, 8, 7}));
  }
  const auto other = read_depth_picture(std::vector{folder_ / "other.png", folder_ / "d.png"});
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("has 8 x 8 pixels, but its depth 8 x 6"), std::string::npos);

  text("d.json", R"({"metres_per_unit":0.001,"fx":8,"fy":8,"cx":3.5,"cy":2.5,"width":8,"height":6,
    "colour":{"fx":16,"fy":16,"cx":7.5,"cy":5.5,"width":16,"height":12,"rotation":[1,0,0,0,1,0,0,0,1],"translation_m":[0.1,0,0]}})");
  const auto registered = read_depth_picture(std::vector{folder_ / "twice.png", folder_ / "d.png"});
  ASSERT_TRUE(registered) << registered.error().sentence();
  EXPECT_EQ(registered->colour->channels, 4);
  EXPECT_EQ(registered->colour->pixel(0, 0)[3], 0.0F) << "no colour where depth is unknown";
  EXPECT_EQ(registered->colour->pixel(3, 3)[3], 1.0F);
}

TEST_F(ADepthPicture, WithNothingKnownIsRefused) {
  ASSERT_TRUE(formats::write_pfm(folder_ / "n.pfm", Raster<float>(3, 3, -1.0F)));
  const auto picture = read("n.pfm");
  ASSERT_FALSE(picture);
  EXPECT_EQ(picture.error().code, ErrorCode::invalid_input);
  EXPECT_NE(picture.error().sentence().find("n.pfm: has no pixel with a depth"), std::string::npos);
}

/// Writes an OpenEXR file of these channels, its data window not at the origin.
void write_exr(const fs::path& path, const std::vector<std::string>& names, const std::vector<float>& values,
               int width, int height) {
  const Imath::Box2i window(Imath::V2i(5, -3), Imath::V2i(5 + width - 1, -3 + height - 1));
  Imf::Header header(window, window);
  Imf::FrameBuffer frame;
  for (const std::string& name : names) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), window, sizeof(float),
                                        sizeof(float) * static_cast<std::size_t>(width)));
  }
  Imf::OutputFile file(path.c_str(), header, 1);
  file.setFrameBuffer(frame);
  file.writePixels(height);
}

TEST_F(ADepthPicture, MayBeOpenExr) {
  std::vector<float> z(12, 1.25F);
  z[5] = 1e10F;
  z[6] = 7.5F;
  write_exr(folder_ / "z.exr", {"R", "G", "B", "Z"}, z, 4, 3);
  const auto picture = read("z.exr");
  ASSERT_TRUE(picture) << picture.error().sentence();
  EXPECT_EQ(metres(picture, 2, 1), 7.5F);
  EXPECT_EQ(picture->unknown, 1U) << "the renderer's background";
  write_exr(folder_ / "one.exr", {"depth.V"}, z, 4, 3);
  EXPECT_EQ(metres(read("one.exr"), 2, 1), 7.5F);
  write_exr(folder_ / "colours.exr", {"R", "G", "B"}, z, 4, 3);
  const auto colours = read("colours.exr");
  ASSERT_FALSE(colours);
  EXPECT_NE(colours.error().message.find("without a channel Z"), std::string::npos);
  std::vector<std::byte> file = *read_file(folder_ / "z.exr");
  for (std::size_t length = 0; length < file.size(); length += 11) {
    ASSERT_TRUE(write_file_atomically(folder_ / "cut.exr", std::span(file).first(length)));
    EXPECT_FALSE(read("cut.exr")) << length;
  }
}

// Photographs with embedded depth, built according to their specifications.

std::string as_string(const std::vector<std::byte>& bytes) { return std::string(as_text(bytes)); }

std::string photograph() {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", cv::Mat(6, 8, CV_8UC3, cv::Scalar(10, 120, 200)), bytes,
               {cv::IMWRITE_JPEG_QUALITY, 100});
  return {bytes.begin(), bytes.end()};
}

std::string with_segments(const std::string& segments) {
  const std::string picture = photograph();
  return picture.substr(0, 2) + segments + picture.substr(2);
}

std::string depth_png() {
  Raster<std::uint8_t> depth(8, 6, 128);
  depth(0, 0) = 0;
  depth(1, 0) = 255;
  return as_string(*formats::encode_png(depth));
}

double inverse_range(double d, double near, double far) { return far * near / (far - d * (far - near)); }

TEST_F(ADepthPicture, MayLieInAPhonesGDepth) {
  text("p.jpg",
       with_segments(segment(kXmpName +
                             "<x:xmpmeta><rdf:Description GDepth:Format=\"RangeInverse\" GDepth:Near=\"0.5\" "
                             "GDepth:Far=\"8\" GDepth:Mime=\"image/png\" GDepth:Data=\"" +
                             base64(depth_png()) + "\"/></x:xmpmeta>")));
  const auto picture = read("p.jpg");
  ASSERT_TRUE(picture) << picture.error().sentence();
  EXPECT_NEAR(metres(picture, 0, 0), 0.5, 1e-5);
  EXPECT_NEAR(metres(picture, 1, 0), 8.0, 1e-4);
  EXPECT_NEAR(metres(picture, 4, 4), inverse_range(128.0 / 255, 0.5, 8), 1e-5);
  ASSERT_TRUE(picture->colour);
  EXPECT_NEAR(255 * picture->colour->pixel(4, 4)[0], 200, 3);
}

TEST_F(ADepthPicture, MayLieInExtendedXmpOverSeveralSegments) {
  const std::string body =
      "<rdf:Description><GDepth:Data>" + base64(depth_png()) + "</GDepth:Data></rdf:Description>";
  const auto part = [&](std::size_t from, std::size_t count) {
    const auto number = [](std::size_t v) {
      return std::string{static_cast<char>(v >> 24U), static_cast<char>(v >> 16U), static_cast<char>(v >> 8U),
                         static_cast<char>(v)};
    };
    return segment(kExtendedName + std::string(32, 'A') + number(body.size()) + number(from) +
                   body.substr(from, count));
  };
  const std::string standard =
      segment(kXmpName + "<a GDepth:Format='RangeLinear' GDepth:Near='1' GDepth:Far='3'/>");
  text("p.jpg", with_segments(standard + part(70, body.size()) + part(0, 70)));
  const auto picture = read("p.jpg");
  ASSERT_TRUE(picture) << picture.error().sentence();
  EXPECT_NEAR(metres(picture, 4, 4), 1.0 + 2.0 * 128 / 255, 1e-5);
}

TEST_F(ADepthPicture, MayLieInADynamicDepthContainer) {
  const std::string depth = depth_png();
  const std::string other = "a video that follows";
  const auto photo = [&](const std::string& behind) {
    return with_segments(
               segment(kXmpName +
                       "<Container:Directory><rdf:Seq><rdf:li><Container:Item Item:Mime=\"image/jpeg\" "
                       "Item:Length=\"0\" "
                       "Item:DataURI=\"primary_image\"/></rdf:li><rdf:li><Container:Item "
                       "Item:Mime=\"image/png\" Item:Length=\"" +
                       std::to_string(depth.size()) +
                       "\" Item:DataURI=\"android/depthmap\"/></rdf:li><rdf:li><Container:Item "
                       "Item:Mime=\"video/mp4\" "
                       "Item:Length=\"20\" Item:DataURI=\"video\"/></rdf:li></rdf:Seq></Container:Directory>"
                       "<DepthMap:Format>RangeInverse</DepthMap:Format><DepthMap:Near>0.4</DepthMap:Near>"
                       "<DepthMap:Far>6</DepthMap:Far><DepthMap:Units>Meters</DepthMap:Units>"
                       "<DepthMap:DepthURI>android/depthmap</DepthMap:DepthURI>")) +
           behind;
  };
  text("p.jpg", photo(depth + other));
  const auto picture = read("p.jpg");
  ASSERT_TRUE(picture) << picture.error().sentence();
  EXPECT_NEAR(metres(picture, 4, 4), inverse_range(128.0 / 255, 0.4, 6), 1e-5);
  text("p.jpg", photo(""));
  EXPECT_FALSE(read("p.jpg")) << "an edited file that lost its depth";
}

TEST_F(ADepthPicture, OfAPhoneWithoutUnitsKeepsOnlyItsShape) {
  text("p.jpg", with_segments(segment(kXmpName + "<a GDepth:Format=\"RangeInverse\" GDepth:Data=\"" +
                                      base64(depth_png()) + "\"/>")));
  const auto picture = read("p.jpg");
  ASSERT_TRUE(picture) << picture.error().sentence();
  EXPECT_GT(disparity(picture, 0, 0), disparity(picture, 4, 4)) << "0 is the near plane";
  EXPECT_GT(disparity(picture, 4, 4), disparity(picture, 1, 0));
  text("p.jpg", with_segments(segment(kXmpName + "<a GDepth:Data=\"AAAA\"/>")));
  const auto damaged = read("p.jpg");
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().message.find("holds a depth map that"), std::string::npos);
}

TEST_F(ADepthPicture, OfRealCamerasIsRead) {
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
  const fs::path apc = fs::path(data) / "depth/apc_bin";
  const auto picture =
      read_depth_picture(std::vector{apc / "frame-000015.color.png", apc / "frame-000015.depth.png"});
  ASSERT_TRUE(picture) << picture.error().sentence();
  EXPECT_TRUE(picture->colour);
  EXPECT_GT(picture->unknown, 0U);
  DepthSettings icl;
  icl.metres_per_unit = 1.0 / 5000;
  const fs::path room = fs::path(data) / "depth/icl_slambook2";
  const auto frame = read_depth_picture(std::vector{room / "color/1.png", room / "depth/1.png"}, icl);
  ASSERT_TRUE(frame) << frame.error().sentence();
  EXPECT_GT(metres(frame, 320, 240), 0.5F);
  EXPECT_LT(metres(frame, 320, 240), 6.0F);
}

}  // namespace
}  // namespace palpable::sources
