// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

Image flat(int width, int height) {
  return {width, height, 1, 8,
          std::vector<float>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
}

TEST(Stereo, NamesEveryMethodBothWays) {
  for (const char* name : {"scanline", "graph-cut", "segments", "pyramid", "fast", "best"}) {
    const auto method = stereo_method_from(name);
    ASSERT_TRUE(method) << name;
    EXPECT_EQ(name_of(*method), name);
  }
  EXPECT_FALSE(stereo_method_from("sgbm"));
}

TEST(Stereo, RefusesPicturesOfDifferentSizeAndTooSmallOnes) {
  const auto differ = match({flat(20, 20), flat(21, 20), {}}, StereoMethod::scanline, {}, {});
  ASSERT_FALSE(differ);
  EXPECT_EQ(differ.error().code, ErrorCode::invalid_input);
  EXPECT_NE(differ.error().message.find("20x20"), std::string::npos);
  const auto tiny = match({flat(1, 1), flat(1, 1), {}}, StereoMethod::scanline, {}, {});
  ASSERT_FALSE(tiny);
  EXPECT_EQ(tiny.error().code, ErrorCode::invalid_input);
}

}  // namespace
}  // namespace palpable::vision
