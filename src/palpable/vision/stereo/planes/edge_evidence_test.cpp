// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/edge_evidence.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 60, kHeight = 6, kEdge = 30;

/// A dark plain surface left of kEdge, and a bright one of the disparity 9 whose columns alternate by
/// `texture` levels.
struct TwoSurfaces {
  ColourPlanes colour;
  Raster<float> disparity{kWidth, kHeight, 9.0F};

  TwoSurfaces(float dark_px, int texture) {
    Raster<std::uint8_t> plane(kWidth, kHeight, 30);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (x >= kEdge)
          plane(x, y) = static_cast<std::uint8_t>(150 + (x % 2) * texture);
        else
          disparity(x, y) = dark_px;
    colour = {plane, plane, plane};
  }
  Raster<float> nearer(const EdgeEvidenceOptions& options = {.reach_px = 5}) const {
    return nearer_beyond_edges(colour, disparity, options, {});
  }
  Raster<std::uint8_t> marked(const EdgeEvidenceOptions& options = {.reach_px = 5}) const {
    const Raster<float> found = nearer(options);
    Raster<std::uint8_t> out(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) out(x, y) = std::isfinite(found(x, y)) ? 1 : 0;
    return out;
  }
};

TEST(EdgeEvidence, MarksThePlainSurfaceBehindANearerOne) {
  const auto marked = TwoSurfaces(4.0F, 30).marked();
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(marked(x, 3) != 0, x >= kEdge - 6 && x < kEdge) << x;
}

TEST(EdgeEvidence, NamesTheNearerSurfacesDisparity) {
  EXPECT_EQ(TwoSurfaces(4.0F, 30).nearer()(kEdge - 1, 3), 9.0F);
}

TEST(EdgeEvidence, MarksAPlainSurfaceThatHasTakenTheDisparityBesideIt) {
  EXPECT_NE(TwoSurfaces(9.0F, 30).marked()(kEdge - 1, 3), 0);
}

TEST(EdgeEvidence, KeepsTheEvidenceOfANearerPlainSurface) {
  EXPECT_EQ(TwoSurfaces(14.0F, 30).marked(), Raster<std::uint8_t>(kWidth, kHeight));
}

TEST(EdgeEvidence, KeepsTheEvidenceOfSurfacesThatAreNarrow) {
  TwoSurfaces scene(4.0F, 30);
  for (int y = 0; y < kHeight; ++y) scene.colour.r(kEdge - 8, y) = 90;
  EXPECT_EQ(scene.marked()(kEdge - 1, 3), 0);
}

TEST(EdgeEvidence, NothingIsMarkedWithoutReach) {
  EXPECT_EQ(TwoSurfaces(4.0F, 30).marked({.reach_px = 0}), Raster<std::uint8_t>(kWidth, kHeight));
}

TEST(EdgeEvidence, TheMirroredPictureIsMarkedMirrored) {
  TwoSurfaces scene(4.0F, 30);
  const auto marked = scene.marked();
  scene.colour = mirrored(scene.colour);
  scene.disparity = mirrored(scene.disparity);
  EXPECT_EQ(scene.marked(), mirrored(marked));
}

}  // namespace
}  // namespace palpable::vision
