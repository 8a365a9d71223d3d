// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/casings.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A street 12 pixels wide along y = 50; `casing` on its sides where x is below `until`.
Raster<Rgb8> street(std::uint8_t casing, int until) {
  Raster<Rgb8> out(200, 100, {240, 238, 232});
  for (int y = 43; y <= 57; ++y)
    for (int x = 0; x < 200; ++x) {
      const bool is_side = y == 43 || y == 57;
      if (is_side && x >= until) continue;
      out(x, y) = is_side ? Rgb8{casing, casing, casing} : Rgb8{255, 255, 255};
    }
  return out;
}

CasedParts parts_of(const Raster<Rgb8>& picture) {
  CentreLine line{{}, 0, 1, 6.5, 0.1};
  for (int x = 0; x < 200; ++x) line.points.push_back({static_cast<double>(x), 50.0});
  return cased_parts(picture, line);
}

double part_of(const Raster<Rgb8>& picture) { return parts_of(picture).any; }

TEST(Casings, ArePartOfALine) {
  EXPECT_EQ(part_of(street(187, 200)), 1.0);
  EXPECT_NEAR(part_of(street(187, 80)), 0.4, 0.02);
  EXPECT_EQ(part_of(street(187, 0)), 0.0);
  // As bright as the land: a border without a line.
  EXPECT_EQ(part_of(street(236, 200)), 0.0);
  // A wood is darker than a casing.
  Raster<Rgb8> wood = street(187, 200);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 200; ++x)
      if (wood(x, y) == Rgb8{240, 238, 232}) wood(x, y) = {150, 170, 140};
  EXPECT_EQ(part_of(wood), 1.0);
}

TEST(Casings, OnOneSideOnlyShowTheRimOfAnArea) {
  Raster<Rgb8> rim = street(187, 200);
  for (int x = 0; x < 200; ++x) rim(x, 57) = {240, 238, 232};
  const CasedParts parts = parts_of(rim);
  EXPECT_EQ(parts.any, 1.0);
  EXPECT_EQ(std::min(parts.left, parts.right), 0.0);
  EXPECT_EQ(std::max(parts.left, parts.right), 1.0);
}

}  // namespace
}  // namespace palpable::vision
