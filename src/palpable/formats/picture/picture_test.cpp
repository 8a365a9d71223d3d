// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/picture/jpeg.hpp"
#include "palpable/formats/picture/pfm.hpp"
#include "palpable/formats/picture/png.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

Image pattern(int width, int height, int channels, int bits) {
  Image image{width, height, channels, bits, {}};
  const int most = bits == 16 ? 65535 : 255;
  const int count = width * height * channels;
  for (int i = 0; i < count; ++i)
    image.samples.push_back(static_cast<float>((i * 7919) % (most + 1)) / static_cast<float>(most));
  return image;
}

TEST(Png, KeepsAllChannelCountsAndBitDepthsExactly) {
  for (const int channels : {1, 2, 3, 4})
    for (const int bits : {8, 16}) {
      const Image image = pattern(13, 7, channels, bits);
      const auto back = decode_png(*encode_png(image));
      ASSERT_TRUE(back) << back.error().sentence();
      EXPECT_EQ(back->channels, channels);
      EXPECT_EQ(back->bits, bits);
      EXPECT_EQ(back->samples, image.samples);
    }
}

TEST(Png, RefusesAFileTruncatedAnywhere) {
  const auto file = *encode_png(pattern(31, 17, 3, 8));
  for (std::size_t length = 0; length < file.size(); ++length)
    EXPECT_FALSE(decode_png(std::span(file).first(length))) << length;
}

TEST(Png, RefusesTooManyPixelsBeforeAllocation) {
  auto file = *encode_png(pattern(4, 4, 1, 8));
  // Changes IHDR's width and height, and its CRC (computed once for this header), which libpng would
  // otherwise refuse.
  const std::string ihdr("IHDR\x00\x00\x4E\x20\x00\x00\x4E\x20\x08\x00\x00\x00\x00", 17);
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : ihdr) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1U) ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
  }
  crc = ~crc;
  for (std::size_t i = 0; i < ihdr.size(); ++i) file[12 + i] = static_cast<std::byte>(ihdr[i]);
  for (std::size_t i = 0; i < 4; ++i) file[29 + i] = static_cast<std::byte>(crc >> (24 - 8 * i));
  const auto refused = decode_png(file);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
  EXPECT_NE(refused.error().message.find("20000 x 20000 pixels are more than"), std::string::npos)
      << refused.error().message;
}

TEST(Png, RefusesToWriteAnEmptyPicture) { EXPECT_FALSE(encode_png(Raster<Rgb8>())); }

TEST(Pfm, KeepsEveryValueAndTheRowOrder) {
  Raster<float> values(3, 2);
  values(0, 0) = 1.5F;
  values(2, 0) = std::numeric_limits<float>::infinity();
  values(0, 1) = -2.25F;
  values(2, 1) = std::numeric_limits<float>::denorm_min();
  const auto file = encode_pfm(values);
  EXPECT_TRUE(has_magic(file, "Pf\n3 2\n-1.0\n"));
  const auto image = decode_pfm(file);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->bits, 32);
  EXPECT_TRUE(std::equal(image->samples.begin(), image->samples.end(), values.values().begin()));
}

TEST(Pfm, ReadsBigEndianColour) {
  const std::string file = std::string("PF 1 1 1.0\n\x3F\x80\0\0\x40\0\0\0\x40\x40\0\0", 11 + 12);
  const auto image = decode_pfm(as_bytes(file));
  ASSERT_TRUE(image);
  EXPECT_EQ(image->channels, 3);
  EXPECT_EQ(image->samples, (std::vector<float>{1.0F, 2.0F, 3.0F}));
}

TEST(Pfm, RefusesABadHeaderOrTooFewPixels) {
  for (const char* text : {"", "Pf", "Pf\n", "Pf\n2 2\n", "Pf\n2 2\n-1.0\n", "Pf\n2 2\n0\nxxxxxxxxxxxxxxxxx",
                           "Pf\n-2 2\n-1.0\nxxxxxxxxxxxxxxxxx", "Pf\n2 2\nnan\nxxxxxxxxxxxxxxxxx",
                           "Pf\n99999999999999999999 2\n-1\nx", "Pf\n20000 20000\n-1\nx"})
    EXPECT_FALSE(decode_pfm(as_bytes(text))) << text;
}

TEST(DisparityFiles, MarkUnknownValues) {
  Raster<float> d(3, 1);
  d(0, 0) = 12.25F;
  d(1, 0) = std::numeric_limits<float>::quiet_NaN();
  d(2, 0) = 0.0F;
  const auto folder = std::filesystem::path(testing::TempDir());
  ASSERT_TRUE(write_disparity_pfm(folder / "palpable-d.pfm", d));
  ASSERT_TRUE(write_disparity_png(folder / "palpable-d.png", d));
  const auto pfm = decode_pfm(*read_file(folder / "palpable-d.pfm"));
  EXPECT_EQ(pfm->samples, (std::vector<float>{12.25F, std::numeric_limits<float>::infinity(), 0.0F}));
  const auto png = decode_png(*read_file(folder / "palpable-d.png"));
  EXPECT_EQ(png->bits, 16);
  EXPECT_EQ(std::lround(65535.0F * png->samples[0]), std::lround(12.25 * 256));
  EXPECT_EQ(std::lround(65535.0F * png->samples[1]), 0);
  EXPECT_EQ(std::lround(65535.0F * png->samples[2]), 1) << "a known disparity of 0 must not read as unknown";
}

TEST(Jpeg, RefusesOtherFilesAndEmptyOnes) {
  EXPECT_FALSE(decode_jpeg({}));
  EXPECT_FALSE(decode_jpeg(as_bytes("this is a text, not a picture")));
}

}  // namespace
}  // namespace palpable::formats
