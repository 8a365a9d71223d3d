// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/recipes/video/video_recipe.hpp"
#include "palpable/session/make/read_input.hpp"

namespace palpable::session {

/// The first scene of a video, which is touched while the requested one is computed: fewer and smaller
/// frames, fewer depth maps, a coarse field. Chosen for a first scene of 150 frames of 640 x 480 pixels
/// within 10 s of processor time (docs/history/2026-11-22-video.md).
struct QuickVideo {
  /// At most this many frames, evenly spaced, 4 … 400; 0 = no quick scene.
  int most_frames = 48;
  /// Frames are reduced by a whole factor until their longer side has at most this many pixels, 80 … 960.
  int longest_side_px = 330;
  int maps = 6;
  int resolution = 96;
  int most_points = 400;
};

/// The video with fewer and smaller frames. At least one frame.
VideoInput quick_video(const VideoInput& video, const QuickVideo& options);

/// The recipe for it.
recipes::VideoRecipe quick_recipe(recipes::VideoRecipe recipe, const QuickVideo& options);

}  // namespace palpable::session
