// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/depth/depth_picture.hpp"
#include "palpable/sources/input/input.hpp"
#include "palpable/sources/picture/photo_depth.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/sources/picture/picture_reply.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <libheif/heif_cxx.h>

namespace palpable::sources {
namespace {

constexpr int kHeifWidth = 64;
constexpr int kHeifHeight = 48;

int ramp(int x) { return 20 + 3 * x; }

/// A reddish HEIC picture whose alpha plane is a ramp: 20, 23, 26 …
std::string with_alpha() {
  heif::Image image;
  image.create(kHeifWidth, kHeifHeight, heif_colorspace_RGB, heif_chroma_interleaved_RGBA);
  image.add_plane(heif_channel_interleaved, kHeifWidth, kHeifHeight, 8);
  int stride = 0;
  std::uint8_t* plane = image.get_plane(heif_channel_interleaved, &stride);
  for (int y = 0; y < kHeifHeight; ++y)
    for (int x = 0; x < kHeifWidth; ++x) {
      const std::array<int, 4> rgba{180, 60, 60, ramp(x)};
      for (int c = 0; c < 4; ++c)
        plane[y * stride + 4 * x + c] = static_cast<std::uint8_t>(rgba[static_cast<std::size_t>(c)]);
    }
  heif::Encoder encoder(heif_compression_HEVC);
  encoder.set_lossy_quality(95);
  heif::Context context;
  context.encode_image(image, encoder);
  class Writer : public heif::Context::Writer {
   public:
    heif_error write(const void* data, std::size_t size) override {
      file.assign(static_cast<const char*>(data), size);
      return {heif_error_Ok, heif_suberror_Unspecified, "Success"};
    }
    std::string file;
  } writer;
  context.write(writer);
  return writer.file;
}

/// libheif cannot write depth, but an alpha plane is stored in the same way: as an auxiliary picture whose
/// type is a name.
std::string with_depth() {
  std::string file = with_alpha();
  for (const auto& [alpha, depth] :
       {std::pair{std::string("urn:mpeg:hevc:2015:auxid:1"), std::string("urn:mpeg:hevc:2015:auxid:2")},
        {"systems:auxiliary:alpha", "systems:auxiliary:depth"}})
    if (const std::size_t at = file.find(alpha); at != std::string::npos)
      file.replace(at, alpha.size(), depth);
  return file;
}

class Heif : public testing::Test {
 protected:
  void SetUp() override {
    if (heif_have_encoder_for_format(heif_compression_HEVC) == 0)
      GTEST_SKIP() << "this libheif cannot encode HEVC";
  }
};

TEST_F(Heif, PictureIsReadWithItsAlpha) {
  const std::string file = with_alpha();
  const auto image = decode_picture(as_bytes(file));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->channels, 4);
  EXPECT_EQ(image->width, kHeifWidth);
  EXPECT_NEAR(255 * image->pixel(20, 20)[0], 180, 4);
  EXPECT_NEAR(255 * image->pixel(20, 20)[3], ramp(20), 4);
  EXPECT_FALSE(*isolated::depth_in_heif(as_bytes(file)));
}

TEST_F(Heif, AuxiliaryDepthIsReadBesideThePicture) {
  const std::string file = with_depth();
  const auto depth = isolated::depth_in_heif(as_bytes(file));
  ASSERT_TRUE(depth) << depth.error().message;
  ASSERT_TRUE(*depth);
  EXPECT_EQ((*depth)->coding, PhotoDepth::Coding::nearness);
  EXPECT_NEAR(255 * (*depth)->values(40, 10), ramp(40), 4);

  const auto path = std::filesystem::path(testing::TempDir()) / "palpable-phone.heic";
  ASSERT_TRUE(write_file_atomically(path, as_bytes(file)));
  EXPECT_EQ(*kind_of_file(path), InputKind::picture);
  EXPECT_EQ(recognise_input(std::vector{path})->kind, InputKind::depth);
  const auto picture = read_depth_picture(std::vector{path});
  ASSERT_TRUE(picture) << picture.error().sentence();
  const auto& disparity = std::get<DisparityMap>(picture->depth).disparity_px;
  EXPECT_NEAR(disparity(40, 10), ramp(40), 4);
  EXPECT_GT(disparity(60, 10), disparity(5, 10));
  ASSERT_TRUE(picture->colour);
  EXPECT_NEAR(255 * picture->colour->pixel(20, 20)[0], 180, 4);
  EXPECT_EQ(picture->notes.size(), 1U);
}

TEST_F(Heif, CutOffAnywhereIsAnError) {
  const std::string file = with_depth();
  for (std::size_t length = 12; length < file.size(); length += 1 + file.size() / 61)
    EXPECT_FALSE(decode_picture(as_bytes(file.substr(0, length)))) << length;
}

}  // namespace
}  // namespace palpable::sources
