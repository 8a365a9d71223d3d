// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

// For tests only.
namespace palpable::vision {

/// A scene of this size with the box in its middle, a quarter of its width and a third of its height.
inline SyntheticScene centred_box_scene(int width, int height) {
  SyntheticScene scene;
  scene.width = width;
  scene.height = height;
  scene.box_left = 3 * width / 8;
  scene.box_right = 5 * width / 8;
  scene.box_top = height / 3;
  scene.box_bottom = 2 * height / 3;
  return scene;
}

}  // namespace palpable::vision
