// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/quick_video.hpp"

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

TEST(QuickVideo, HasFewerAndSmallerFramesAndTheirCamera) {
  VideoInput video;
  for (int i = 0; i < 100; ++i) video.frames.push_back({2 * i, Raster<Rgb8>(640, 480, Rgb8{10, 20, 30})});
  video.frames[0].picture(0, 0) = video.frames[0].picture(1, 0) = {250, 20, 30};
  video.camera = {{560, 560, 319.5, 239.5, 640, 480}, true};
  const VideoInput quick = quick_video(video, {});
  EXPECT_LE(quick.frames.size(), 48U);
  EXPECT_GE(quick.frames.size(), 30U);
  EXPECT_EQ(quick.frames[1].number, 6);
  EXPECT_EQ(quick.frames[0].picture.width(), 320);
  EXPECT_EQ(quick.frames[0].picture(0, 0), (Rgb8{130, 20, 30}));
  EXPECT_EQ(quick.camera.pinhole, (Pinhole{280, 280, 159.5, 119.5, 320, 240}));
  EXPECT_EQ(quick.reduction, 0.5);
}

TEST(QuickVideo, KeepsASmallVideoAsItIs) {
  VideoInput video;
  for (int i = 0; i < 20; ++i) video.frames.push_back({i, Raster<Rgb8>(160, 120)});
  video.camera = {{150, 150, 79.5, 59.5, 160, 120}, false};
  const VideoInput quick = quick_video(video, {});
  EXPECT_EQ(quick.frames.size(), 20U);
  EXPECT_EQ(quick.camera.pinhole, video.camera.pinhole);
}

TEST(QuickRecipe, OfACorrectedSurfaceIsItsSuperquadricsAlone) {
  recipes::VideoRecipe corrected;
  corrected.surface = recipes::VideoSurface::corrected;
  corrected.grown = [](recipes::MadeScene) {};
  const recipes::VideoRecipe quick = quick_recipe(corrected, {});
  EXPECT_EQ(quick.surface, recipes::VideoSurface::superquadrics);
  EXPECT_FALSE(quick.grown);
}

TEST(QuickRecipe, EstimatesNoRollingShutter) {
  EXPECT_EQ(quick_recipe({}, {}).motion.rolling_shutter, 0);
  EXPECT_EQ(recipes::VideoRecipe{}.motion.rolling_shutter, 1);
}

TEST(QuickRecipe, SearchesDepthOnOneFamilyOfPlanes) {
  EXPECT_EQ(quick_recipe({}, {}).depth.facing_too, 0);
  EXPECT_EQ(recipes::VideoRecipe{}.depth.facing_too, 1);
}

}  // namespace
}  // namespace palpable::session
