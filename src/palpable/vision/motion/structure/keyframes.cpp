// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/keyframes.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <cmath>

namespace palpable::vision {
namespace {

// Median movement of the points between two frames, px; -1 if they share too few.
double movement_px(std::span<const PointTrack> tracks, int a, int b, int least_points) {
  std::vector<double> steps;
  for (const PointTrack& track : tracks)
    if (track.in_frame(a) && track.in_frame(b))
      steps.push_back(std::hypot(track.in(a).x - track.in(b).x, track.in(a).y - track.in(b).y));
  return static_cast<int>(steps.size()) < least_points ? -1.0 : quantile_of(steps, 0.5);
}

// The share of a frame's points that are in another one too.
double kept_share(std::span<const PointTrack> tracks, int a, int b) {
  int in_a = 0, in_both = 0;
  for (const PointTrack& track : tracks)
    if (track.in_frame(a)) ++in_a, in_both += track.in_frame(b) ? 1 : 0;
  return in_a > 0 ? static_cast<double>(in_both) / in_a : 1.0;
}

// Appends the keyframes after `a` up to `b`: halfway ones too, until enough points stay from one to the next.
// A keyframe's pose needs points that two keyframes before it determine.
void append_keyframes(std::span<const PointTrack> tracks, int a, int b, double least_kept,
                      std::vector<int>& to) {
  if (b - a > 1 && kept_share(tracks, a, b) < least_kept) {
    const int middle = a + (b - a) / 2;
    append_keyframes(tracks, a, middle, least_kept, to);
    append_keyframes(tracks, middle, b, least_kept, to);
    return;
  }
  to.push_back(b);
}

}  // namespace

std::vector<int> choose_keyframes(std::span<const PointTrack> tracks, int frame_count, int picture_width,
                                  const BatchMotionOptions& options) {
  std::vector<int> out{0};
  for (int frame = 1; frame < frame_count; ++frame) {
    const double moved = movement_px(tracks, out.back(), frame, 4 * options.least_points);
    if (moved > options.keyframe_step * picture_width || moved < 0 || frame + 1 == frame_count)
      out.push_back(frame);
  }
  std::vector<int> with_halfway{0};
  for (std::size_t i = 1; i < out.size(); ++i)
    append_keyframes(tracks, out[i - 1], out[i], options.keyframe_kept, with_halfway);
  return with_halfway;
}

}  // namespace palpable::vision
