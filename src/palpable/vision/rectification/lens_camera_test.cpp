// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/lens_camera.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(UsualCamera, SpansItsFieldOfViewAcrossThePicture) {
  const LensCamera camera = usual_camera(641, 481);
  EXPECT_NEAR(2.0 * std::atan(320.5 / camera.matrix[0]) * 180.0 / 3.14159265358979, 65.0, 1e-9);
  EXPECT_EQ(camera.matrix[0], camera.matrix[4]);
  EXPECT_EQ(camera.matrix[2], 320.0);
  EXPECT_EQ(camera.matrix[5], 240.0);
  EXPECT_TRUE(camera.distortion.empty());
}

}  // namespace
}  // namespace palpable::vision
