// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/measure/camera_path_score.hpp"
#include "palpable/vision/motion/depth/video_depth.hpp"

#include <vector>

#include "rendered_video.hpp"

namespace palpable::bench {

/// Depth maps of a rendered video beside the truth; all in percent.
struct DepthFigures {
  /// Of the pixels that show the model or the table near it.
  double known = 0, good_of_all = 0;
  /// Within 1 %, of the known pixels, and of those with texture: the grey levels of 9 x 9 pixels have a
  /// standard deviation above 4.
  double good_of_known = 0, good_of_textured = 0;
  /// Distance of the known places from the true surface (root mean square without the largest 2 %), of the
  /// diagonal of the box around all true places.
  double structure = 0;
};

/// `pictures`: of all frames.
DepthFigures depth_figures(const std::vector<vision::FrameDepth>& maps,
                           const std::vector<Raster<Rgb8>>& pictures, const RenderedVideo& video,
                           const measure::CameraPathScore& path, const Work& work);

/// One map beside the truth, for looking at: the frame in grey; red and green where it is known, has texture
/// and is too far and too near by more than 1 %, blue where it is unknown and has texture; weaker where there
/// is no texture.
Raster<Rgb8> depth_errors_of(const vision::FrameDepth& map, const Raster<Rgb8>& picture,
                             const RenderedVideo& video, const measure::CameraPathScore& path,
                             const Work& work);

}  // namespace palpable::bench
