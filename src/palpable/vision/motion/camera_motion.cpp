// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/camera_motion.hpp"

#include "palpable/core/quantile.hpp"
#include "palpable/vision/motion/first_pair.hpp"
#include "palpable/vision/motion/reconstruction.hpp"

#include <cmath>

namespace palpable::vision {
namespace {

double moved_px(std::span<const PointTrack> tracks, int a, int b, int least_points) {
  std::vector<double> steps;
  for (const PointTrack& track : tracks)
    if (track.in_frame(a) && track.in_frame(b))
      steps.push_back(std::hypot(track.in(a).x - track.in(b).x, track.in(a).y - track.in(b).y));
  return static_cast<int>(steps.size()) < least_points ? -1.0 : quantile_of(steps, 0.5);
}

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

// The first frame, then each frame in which points have moved far enough, or too few are left.
std::vector<int> choose_keyframes(std::span<const PointTrack> tracks, int frame_count, const Pinhole& camera,
                                  const BatchMotionOptions& options) {
  std::vector<int> out{0};
  for (int frame = 1; frame < frame_count; ++frame) {
    const double moved = moved_px(tracks, out.back(), frame, 4 * options.least_points);
    if (moved > options.keyframe_step * camera.width || moved < 0 || frame + 1 == frame_count)
      out.push_back(frame);
  }
  std::vector<int> with_halfway{0};
  for (std::size_t i = 1; i < out.size(); ++i)
    append_keyframes(tracks, out[i - 1], out[i], options.keyframe_kept, with_halfway);
  return with_halfway;
}

}  // namespace

std::vector<Parameter> parameters_of(BatchMotionOptions& o) {
  return {{"keyframe_step",
           &o.keyframe_step,
           {0.002, 0.5},
           "",
           "Movement of points between keyframes, share of the width"},
          {"keyframe_kept",
           &o.keyframe_kept,
           {0, 1},
           "",
           "Share of a keyframe's points that are in the next one"},
          {"least_angle_deg", &o.least_angle_deg, {0.1, 20}, "degrees", "Least angle between lines of sight"},
          {"outlier_px", &o.outlier_px, {0.1, 20}, "px", "Larger errors count as wrong tracks"},
          {"robust_px", &o.robust_px, {0.05, 10}, "px", "Larger errors count linearly"},
          {"least_points", &o.least_points, {6, 1000}, "", "Points that a frame's pose needs"}};
}

Result<CameraMotion> motion_from_tracks(std::span<const PointTrack> tracks, int frame_count,
                                        const VideoCamera& camera, const BatchMotionOptions& options,
                                        const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  const std::vector<int> keyframes = choose_keyframes(tracks, frame_count, camera.pinhole, options);
  const auto pair = choose_first_pair(tracks, keyframes, camera.pinhole, options, work);
  if (!pair) return pair.error();
  Reconstruction reconstruction(tracks, keyframes, camera, options);
  reconstruction.begin(*pair, work);
  int added = 0;
  for (int next; (next = reconstruction.next_keyframe()) >= 0;) {
    if (work.cancelled()) return Work::interrupted();
    if (!reconstruction.add_keyframe(next)) continue;
    if (++added % 3 == 0) reconstruction.refine(5, work);
    reconstruction.triangulate_all();
    work.report(static_cast<double>(added) / static_cast<double>(keyframes.size()),
                "finding the camera's path");
  }
  reconstruction.refine(20, work);
  reconstruction.triangulate_all();
  reconstruction.refine(30, work);
  reconstruction.add_all_frames(frame_count, work);
  reconstruction.refine(30, work);
  if (work.cancelled()) return Work::interrupted();
  return reconstruction.result();
}

}  // namespace palpable::vision
