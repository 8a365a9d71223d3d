// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"

namespace palpable {

/// A frame of a video, or a picture of a sequence.
struct VideoFrame {
  /// In the video, counted from 0; frames may be left out.
  int number = 0;
  Raster<Rgb8> picture;
};

}  // namespace palpable
