// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/stereo/stereo_file.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/sources/input/input.hpp"
#include "palpable/sources/picture/made_files.hpp"

#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace palpable::sources {
namespace {

namespace fs = std::filesystem;

std::string jpeg(int width, int height, int grey) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", cv::Mat(height, width, CV_8UC3, cv::Scalar::all(grey)), bytes);
  return {bytes.begin(), bytes.end()};
}

int grey_of(const Image& image) { return static_cast<int>(std::lround(255 * image.pixel(1, 1)[0])); }

/// Left half dark, right half light.
std::string dark_and_light(int width, int height) {
  cv::Mat m(height, width, CV_8UC3, cv::Scalar::all(40));
  m.colRange(width / 2, width).setTo(cv::Scalar::all(200));
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", m, bytes, {cv::IMWRITE_JPEG_QUALITY, 100});
  return {bytes.begin(), bytes.end()};
}

TEST(StereoFile, OfAMultiPictureCameraGivesItsTwoPictures) {
  const std::string file = mpo(jpeg(48, 32, 40), jpeg(48, 32, 200), kDisparity);
  EXPECT_TRUE(is_stereo_jpeg(as_bytes(file)));
  const auto pair = decode_stereo(as_bytes(file));
  ASSERT_TRUE(pair) << pair.error().message;
  EXPECT_NEAR(grey_of(pair->left), 40, 2);
  EXPECT_NEAR(grey_of(pair->right), 200, 2);
  for (std::size_t length = file.size() - 600; length < file.size(); length += 50)
    EXPECT_FALSE(decode_stereo(as_bytes(file.substr(0, length)))) << length;
}

TEST(StereoFile, IsNotSeenInAPhonesPreviewOrGainMap) {
  constexpr std::uint32_t kLargeThumbnail = 0x010001;
  for (const std::uint32_t kind : {kLargeThumbnail, 0x030000U, 0U}) {
    const std::string file = mpo(jpeg(48, 32, 40), jpeg(24, 16, 200), kind);
    EXPECT_FALSE(is_stereo_jpeg(as_bytes(file)));
    const auto path = fs::path(testing::TempDir()) / "palpable-phone.jpg";
    ASSERT_TRUE(write_file_atomically(path, as_bytes(file)));
    EXPECT_EQ(*kind_of_file(path), InputKind::picture);
  }
}

TEST(StereoFile, OfJpsIsSplitAsItsDescriptorSays) {
  constexpr std::uint32_t kSideBySide = 0x0201;
  constexpr std::uint32_t kLeftFirst = 4U << 16U;
  const std::string picture = dark_and_light(96, 32);
  EXPECT_TRUE(is_stereo_jpeg(as_bytes(jps(picture, kSideBySide))));
  const auto crossed = decode_stereo(as_bytes(jps(picture, kSideBySide)));
  ASSERT_TRUE(crossed) << crossed.error().message;
  EXPECT_NEAR(grey_of(crossed->left), 200, 3)
      << "the right eye's picture comes first unless the file says otherwise";
  const auto parallel = decode_stereo(as_bytes(jps(picture, kSideBySide | kLeftFirst)));
  EXPECT_NEAR(grey_of(parallel->left), 40, 3);
  const auto squeezed = decode_stereo(as_bytes(jps(picture, kSideBySide | kLeftFirst | (2U << 16U))));
  ASSERT_TRUE(squeezed);
  EXPECT_EQ(squeezed->left.width, 96);
  EXPECT_EQ(squeezed->notes.size(), 1U);
  EXPECT_FALSE(decode_stereo(as_bytes(jps(picture, 0x0401)))) << "an anaglyph";
  EXPECT_FALSE(is_stereo_jpeg(as_bytes(jps(picture, 0x0200)))) << "a mono picture";
}

TEST(StereoFile, OfAnyPictureIsSplitByItsShapeOrAsAsked) {
  const std::string wide = dark_and_light(96, 32);
  EXPECT_NEAR(grey_of(decode_stereo(as_bytes(wide))->left), 40, 3);
  EXPECT_NEAR(grey_of(decode_stereo(as_bytes(wide), StereoLayout::side_by_side_crossed)->left), 200, 3);
  EXPECT_EQ(decode_stereo(as_bytes(wide), StereoLayout::over_under)->left.height, 16);
  EXPECT_EQ(decode_stereo(as_bytes(jpeg(32, 96, 9)))->left.height, 48);
}

TEST(StereoFile, OfTwoSizesIsRefusedWithBoth) {
  const auto folder = fs::path(testing::TempDir());
  ASSERT_TRUE(formats::write_png(folder / "palpable-l.png", Raster<Rgb8>(8, 6)));
  ASSERT_TRUE(formats::write_png(folder / "palpable-r.png", Raster<Rgb8>(9, 6)));
  const std::vector<fs::path> files{folder / "palpable-l.png", folder / "palpable-r.png"};
  const auto pair = read_stereo(files);
  ASSERT_FALSE(pair);
  EXPECT_EQ(pair.error().code, ErrorCode::invalid_input);
  EXPECT_NE(pair.error().message.find("left has 8 x 6 pixels and the right 9 x 6"), std::string::npos);
  EXPECT_TRUE(read_stereo(std::vector{files[0], files[0]}));
  EXPECT_FALSE(read_stereo(std::vector{files[0], folder / "none.png"}));
}

}  // namespace
}  // namespace palpable::sources
