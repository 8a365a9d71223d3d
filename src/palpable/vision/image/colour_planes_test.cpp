// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/colour_planes.hpp"

#include <array>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

Raster<Rgb8> picture() {
  Raster<Rgb8> out(3, 1);
  out(0, 0) = {10, 20, 30};
  out(1, 0) = {15, 0, 33};
  out(2, 0) = {10, 20, 130};
  return out;
}

TEST(ColourPlanes, HoldThePicturesChannels) {
  const ColourPlanes planes = colour_planes(picture());
  EXPECT_EQ(planes.r(1, 0), 15);
  EXPECT_EQ(planes.g(1, 0), 0);
  EXPECT_EQ(planes.b(1, 0), 33);
}

TEST(ColourPlanes, DifferByTheirChannelThatDiffersMost) {
  const ColourPlanes planes = colour_planes(picture());
  EXPECT_EQ(planes.difference(0, 0, 1, 0), 20);
  EXPECT_EQ(planes.difference(2, 0, 0, 0), 100);
  std::array<std::uint8_t, 2> differences{};
  colour_differences(planes, 0, 0, 1, 0, 2, differences.data());
  EXPECT_EQ(differences[0], 20);
  EXPECT_EQ(differences[1], 97);
}

TEST(ColourPlanes, MirroredHaveLeftAndRightExchanged) {
  const ColourPlanes planes = mirrored(colour_planes(picture()));
  EXPECT_EQ(planes.b(0, 0), 130);
  EXPECT_EQ(planes.g(1, 0), 0);
}

}  // namespace
}  // namespace palpable::vision
