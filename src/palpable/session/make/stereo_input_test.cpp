// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/stereo_input.hpp"

#include "palpable/core/files/atomic_file.hpp"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <span>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::session {
namespace {

constexpr int kWidth = 400, kHeight = 300;

class ReadStereoPair : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "palpable-pair-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    input_.pictures = {write("left.pgm", picture(1)), write("right.pgm", picture(2))};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string picture(unsigned seed) {
    std::mt19937 random(seed);
    std::string file = "P5 " + std::to_string(kWidth) + " " + std::to_string(kHeight) + " 255\n";
    for (int i = 0; i < kWidth * kHeight; ++i) file += static_cast<char>(random() % 256);
    return file;
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    EXPECT_TRUE(write_file_atomically(folder_ / name, std::as_bytes(std::span(text))));
    return folder_ / name;
  }

  std::filesystem::path folder_;
  StereoInput input_;
};

TEST_F(ReadStereoPair, LargePicturesAreReducedWithTheirCalibration) {
  input_.calibration = write("camera.json", R"({"fx": 500, "fy": 480, "cx": 201.5, "cy": 140.5, "width": 400,
      "height": 300, "baseline_m": 0.12, "doffs": 6})");
  const auto whole = read_stereo_pair(input_, {});
  ASSERT_TRUE(whole) << whole.error().sentence();
  EXPECT_EQ(whole->pair.left.width, kWidth);
  EXPECT_THAT(whole->notes, testing::IsEmpty());

  input_.most_pixels = kWidth * kHeight / 4;
  const auto half = read_stereo_pair(input_, {});
  ASSERT_TRUE(half) << half.error().sentence();
  EXPECT_EQ(half->pair.left.width, kWidth / 2);
  EXPECT_EQ(half->pair.right.height, kHeight / 2);
  EXPECT_THAT(half->notes.front().sentence, testing::HasSubstr("from 400 x 300 to 200 x 150"));
  const Image& before = whole->pair.right;
  const float mean =
      0.25F * (*before.pixel(6, 10) + *before.pixel(7, 10) + *before.pixel(6, 11) + *before.pixel(7, 11));
  EXPECT_NEAR(*half->pair.right.pixel(3, 5), mean, 1e-4F);

  // A point at depth Z is on the same ray, and its disparity is half as large.
  ASSERT_TRUE(half->pair.rig);
  EXPECT_DOUBLE_EQ(half->pair.rig->left.fx, 250.0);
  EXPECT_DOUBLE_EQ(half->pair.rig->left.fy, 240.0);
  EXPECT_DOUBLE_EQ(half->pair.rig->left.cx, (201.5 + 0.5) / 2.0 - 0.5);
  EXPECT_DOUBLE_EQ(half->pair.rig->left.cy, (140.5 + 0.5) / 2.0 - 0.5);
  EXPECT_DOUBLE_EQ(half->pair.rig->doffs_px, 3.0);
  EXPECT_DOUBLE_EQ(half->pair.rig->baseline_m, 0.12);
}

}  // namespace
}  // namespace palpable::session
