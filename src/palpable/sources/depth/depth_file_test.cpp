// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/depth_file.hpp"

#include "palpable/formats/packing/npz.hpp"
#include "palpable/formats/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

namespace fs = std::filesystem;

fs::path scratch(const char* name) {
  return fs::path(testing::TempDir()) / (std::string("palpable-depth-") + name);
}

Raster<std::uint16_t> ramp() {
  Raster<std::uint16_t> values(256, 256);
  for (std::size_t i = 0; i < values.count(); ++i) values.values()[i] = static_cast<std::uint16_t>(i);
  return values;
}

TEST(DepthFile, GivesEverySixteenBitNumberExactly) {
  ASSERT_TRUE(formats::write_png(scratch("16.png"), ramp()));
  const auto values = read_raster(scratch("16.png"));
  ASSERT_TRUE(values) << values.error().sentence();
  for (std::size_t i = 0; i < values->count(); ++i) ASSERT_EQ(values->values()[i], static_cast<float>(i));
}

TEST(DepthFile, ScalesToMetresAndCountsTheUnknown) {
  ASSERT_TRUE(formats::write_png(scratch("mm.png"), ramp()));
  const auto depth = read_depth(scratch("mm.png"), 0.001);
  ASSERT_TRUE(depth);
  EXPECT_EQ(depth->unknown, 1U);
  EXPECT_TRUE(std::isnan(depth->depth.depth_m(0, 0)));
  EXPECT_FLOAT_EQ(depth->depth.depth_m(255, 255), 65.535F);
}

TEST(DepthFile, TreatsZeroNegativeAndNotANumberAsUnknown) {
  Raster<float> z(5, 1);
  z(0, 0) = 0.0F;
  z(1, 0) = -1.0F;
  z(2, 0) = std::numeric_limits<float>::quiet_NaN();
  z(3, 0) = std::numeric_limits<float>::infinity();
  z(4, 0) = 1.25F;
  ASSERT_TRUE(formats::write_pfm(scratch("z.pfm"), z));
  const auto depth = read_depth(scratch("z.pfm"), 1.0);
  ASSERT_TRUE(depth);
  EXPECT_EQ(depth->unknown, 4U);
  EXPECT_EQ(depth->depth.depth_m(4, 0), 1.25F);

  z(4, 0) = -2.0F;
  ASSERT_TRUE(formats::write_pfm(scratch("z.pfm"), z));
  const auto none = read_depth(scratch("z.pfm"), 1.0);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::invalid_input);
  EXPECT_NE(none.error().message.find("no pixel with a depth"), std::string::npos);
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(read_depth(scratch("z.pfm"), scale).error().code, ErrorCode::usage);
}

TEST(DepthFile, GivesBackTheDisparityThatWasWritten) {
  Raster<float> d(3, 1);
  d(0, 0) = 12.25F;
  d(1, 0) = std::numeric_limits<float>::quiet_NaN();
  d(2, 0) = 0.5F;
  ASSERT_TRUE(formats::write_disparity_pfm(scratch("d.pfm"), d));
  ASSERT_TRUE(formats::write_disparity_png(scratch("d.png"), d));
  for (const auto& back : {read_disparity(scratch("d.pfm"), 1.0, UnknownDisparity::not_finite),
                           read_disparity(scratch("d.png"), 1.0 / 256, UnknownDisparity::zero_too)}) {
    ASSERT_TRUE(back);
    EXPECT_EQ(back->unknown, 1U);
    EXPECT_EQ(back->disparity.disparity_px(0, 0), 12.25F);
    EXPECT_TRUE(std::isnan(back->disparity.disparity_px(1, 0)));
    EXPECT_EQ(back->disparity.disparity_px(2, 0), 0.5F);
  }
}

TEST(DepthFile, MayBeANumPyArray) {
  Raster<float> z(3, 2, 2.0F);
  z(2, 1) = 3.0F;
  ASSERT_TRUE(formats::write_npz(scratch("z.npz"),
                                 {{"depth", formats::npy_array(z)}, {"fx", formats::npy_array(1.0)}}));
  EXPECT_EQ(*read_raster(scratch("z.npz")), z);
  ASSERT_TRUE(
      formats::write_npz(scratch("z.npz"), {{"a", formats::npy_array(z)}, {"b", formats::npy_array(z)}}));
  EXPECT_FALSE(read_raster(scratch("z.npz")));
}

TEST(DepthFile, ThatIsColouredIsRefused) {
  ASSERT_TRUE(formats::write_png(scratch("c.png"), Raster<Rgb8>(4, 4, {1, 2, 3})));
  const auto values = read_raster(scratch("c.png"));
  ASSERT_FALSE(values);
  EXPECT_NE(values.error().sentence().find("coloured picture"), std::string::npos);
  ASSERT_TRUE(formats::write_png(scratch("c.png"), Raster<Rgb8>(4, 4, {7, 7, 7})));
  EXPECT_EQ((*read_raster(scratch("c.png")))(1, 1), 7.0F);
}

TEST(DepthFile, OfRealCamerasAndRenderersIsRead) {
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
  const fs::path folder(data);
  const auto box = read_depth(folder / "depth/apc_bin/frame-000015.depth.png", 0.001);
  ASSERT_TRUE(box) << box.error().sentence();
  std::vector<float> known;
  for (const float z : box->depth.depth_m.values())
    if (std::isfinite(z)) known.push_back(z);
  std::sort(known.begin(), known.end());
  EXPECT_NEAR(known[known.size() / 2], 0.5, 0.2) << "the box stands about 0.4 m away";
  const auto room = read_depth(folder / "depth/icl_slambook2/depth/1.png", 1.0 / 5000);
  ASSERT_TRUE(room) << room.error().sentence();
  const auto heads =
      read_disparity(folder / "stereo/rendered_heads/disp_left.pfm", 1.0, UnknownDisparity::not_finite);
  ASSERT_TRUE(heads) << heads.error().sentence();
  const auto motorcycle = read_disparity(folder / "stereo/mid14_Motorcycle/motorcycle_disp.npz", 1.0,
                                         UnknownDisparity::not_finite);
  ASSERT_TRUE(motorcycle) << motorcycle.error().sentence();
  EXPECT_LT(motorcycle->unknown, 741U * 500U / 4);
}

}  // namespace
}  // namespace palpable::sources
