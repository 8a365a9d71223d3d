// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/motion/depth/video_depth.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

/// When a frame shows something else than the surface that other frames measured, such as a hand in front of
/// it. A smooth hand has no corners, so moving_points() does not find it.
struct CoveredFrameOptions {
  /// Blocks of so many pixels are compared by their mean colours, px, 2 … 64.
  int block_px = 8;
  /// Another frame shows the surface if its depth there differs by less than this share, 0.001 … 0.2.
  double tolerance = 0.02;
  /// So many other frames must show it, 2 … 16, in colours that differ from their median by less than half
  /// of least_difference.
  int least_frames = 2;
  /// A block is covered if a channel of its colour differs from that median by more than this, levels, 1 …
  /// 255. The frames' brightness is equalised first.
  double least_difference = 30;
};
std::vector<Parameter> parameters_of(CoveredFrameOptions& options);

/// For each map the largest connected area of its frame that is covered, as a share of the picture. Only
/// blocks are judged whose depth this map did not measure, and other maps did. `pictures`: one for each frame
/// of the video, of the maps' size. Any thread.
std::vector<double> covered_shares(std::span<const FrameDepth> maps,
                                   std::span<const Raster<Rgb8>* const> pictures,
                                   const CoveredFrameOptions& options);

}  // namespace palpable::vision
