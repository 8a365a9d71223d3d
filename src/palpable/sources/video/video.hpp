// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"

#include <vector>

namespace palpable::sources {

struct VideoFrame {
  /// In the file, counted from 0; frames may be left out.
  int number = 0;
  Raster<Rgb8> picture;
};

/// Frames of a video or a folder of pictures, upright, all of one size.
struct Video {
  std::vector<VideoFrame> frames;
  /// Of a frame in the file, upright; the frames here may be smaller.
  int full_width = 0;
  int full_height = 0;
};

/// Frames are reduced so that no side is longer, px.
inline constexpr int kLongestVideoSide = 960;
/// Of more frames every second, third … is taken.
inline constexpr int kMostVideoFrames = 400;

}  // namespace palpable::sources
