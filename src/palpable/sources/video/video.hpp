// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/video_frame.hpp"
#include "palpable/core/result.hpp"

#include <optional>
#include <vector>

namespace palpable::sources {

/// Frames of a video or a folder of pictures, upright, all of one size.
struct Video {
  std::vector<VideoFrame> frames;
  /// Size of a frame in the file, upright; the frames here may be smaller.
  int full_width = 0;
  int full_height = 0;
  /// Frames that a damaged file states or holds, or pictures of a folder, that could not be read.
  int lost = 0;
  /// Why the first of these pictures of a folder could not be read, with its file.
  std::optional<Error> first_lost = std::nullopt;
  /// As the first picture of a folder states it, for a film of 36 x 24 mm.
  std::optional<double> focal_length_35mm = std::nullopt;
};

/// Longest side of a frame, px; larger frames are reduced.
inline constexpr int kLongestVideoSide = 960;
/// Greatest number of frames; of more, only every second, third, … is kept.
inline constexpr int kMostVideoFrames = 400;

}  // namespace palpable::sources
