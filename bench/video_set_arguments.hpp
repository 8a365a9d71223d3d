// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "video_faults.hpp"
#include "video_surfaces.hpp"

// Structure, motion and depth of rendered videos (rendered_video.hpp) with their exact truth:
//
//   palpable_video_set [--seeds N] [--first SEED] [--frames N] [--threads N] [--no-depth] [--set NAME=VALUE]…
//                      [--marker MM] [--hand PERCENT] [--smooth-hand PERCENT] [--defocus PX] [--filter]
//                      [--fused] [--surfaces]
//                      [--steps]
//                      [--true-depth] [--write FOLDER] [--read FOLDER] [--errors FOLDER]
//
// Names are those of `palpable make --set video.…`: tracks.…, motion.…, depth.… --write writes the frames,
// poses.csv in metres, and intrinsics.json; --read
// takes them from there, which is faster than rendering. --errors writes where each depth map is wrong.
// --fused compares the model's fused surface with the truth, --surfaces also the corrected one;
// --steps prints each step of the correction; --true-depth makes them of the true poses and depth with noise.
// --filter finds the path by the Kalman filter.
// --hand lets a hand that covers so much of the picture wander through the view, --smooth-hand one without
// texture, --defocus blurs all frames: the columns of moving points, covered areas and edges show what the
// advice's limits divide.
// --marker lays a printed marker of this side on the board, and the table then states the error of the scale
// that follows from it.
namespace palpable::bench {

struct VideoSetArguments {
  int seeds = 12, first = 1, frames = 60;
  unsigned threads = 2;
  bool depth = true, steps = false, true_depth = false;
  Surfaces surfaces = Surfaces::none;
  /// Side of a printed marker on the board; 0 = none.
  int marker_mm = 0;
  int hand_percent = 0, defocus_px = 0;
  double hand_contrast = MovingHand().contrast;
  std::string folder, written, errors;
  recipes::VideoRecipe recipe;
};

inline constexpr const char* kVideoSetUsage =
    "palpable_video_set [--seeds N] [--first SEED] [--frames N] [--threads N] [--no-depth] "
    "[--set NAME=VALUE]... [--marker MM] [--hand PERCENT] [--smooth-hand PERCENT] [--defocus PX] [--filter] "
    "[--fused] [--surfaces] [--steps] [--true-depth] [--write FOLDER] [--read FOLDER] [--errors FOLDER]\n";

/// False for words that are none of these.
bool read(int count, char** words, VideoSetArguments& out);

}  // namespace palpable::bench
