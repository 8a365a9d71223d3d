// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/camera_motion.hpp"

#include "palpable/vision/motion/structure/first_pair.hpp"
#include "palpable/vision/motion/structure/keyframes.hpp"
#include "palpable/vision/motion/structure/reconstruction.hpp"

namespace palpable::vision {

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
          {"least_points", &o.least_points, {6, 1000}, "", "Points that a frame's pose needs"},
          {"most_attempts", &o.most_attempts, {1, 100}, "", "Times that a keyframe is added again"},
          {"refined_every", &o.refined_every, {1, 100}, "", "Added keyframes between two refinements"},
          {"early_iterations", &o.early_iterations, {1, 1000}, "", "Iterations of each of these"},
          {"keyframe_iterations",
           &o.keyframe_iterations,
           {1, 1000},
           "",
           "Iterations when all keyframes are added"},
          {"final_iterations", &o.final_iterations, {1, 1000}, "", "Iterations of the last refinements"},
          {"views_for_focal_length",
           &o.views_for_focal_length,
           {2, 100},
           "",
           "Poses that an unknown focal length needs to be refined"},
          {"rolling_shutter", &o.rolling_shutter, {0, 1}, "", "1: a rolling shutter is estimated"},
          {"least_readout_gain",
           &o.least_readout_gain,
           {0, 1},
           "",
           "Share by which it must lower the squared errors"}};
}

Result<CameraMotion> motion_from_tracks(std::span<const PointTrack> tracks,
                                        std::span<const int> frame_numbers, const VideoCamera& camera,
                                        const BatchMotionOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  const int frame_count = static_cast<int>(frame_numbers.size());
  const std::vector<int> keyframes = choose_keyframes(tracks, frame_count, camera.pinhole.width, options);
  const auto pair = choose_first_pair(tracks, keyframes, camera.pinhole, options, work);
  if (!pair) return pair.error();
  Reconstruction reconstruction(tracks, keyframes, camera, options);
  reconstruction.begin(*pair, work);
  int added = 0;
  for (int next; (next = reconstruction.next_keyframe()) >= 0;) {
    if (work.cancelled()) return Work::interrupted();
    if (!reconstruction.add_keyframe(next)) continue;
    if (++added % options.refined_every == 0) reconstruction.refine(options.early_iterations, work);
    reconstruction.triangulate_all();
    work.report(static_cast<double>(added) / static_cast<double>(keyframes.size()),
                "finding the camera's path");
  }
  reconstruction.refine(options.keyframe_iterations, work);
  reconstruction.triangulate_all();
  reconstruction.refine(options.final_iterations, work);
  reconstruction.add_all_frames(frame_count, work);
  reconstruction.refine(options.final_iterations, work);
  if (options.rolling_shutter == 1)
    reconstruction.find_readout(frame_numbers, options.final_iterations, work);
  if (work.cancelled()) return Work::interrupted();
  return reconstruction.result();
}

}  // namespace palpable::vision
