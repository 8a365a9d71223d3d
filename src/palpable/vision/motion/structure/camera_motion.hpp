// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/vision/motion/tracks/point_tracks.hpp"
#include "palpable/vision/motion/tracks/rolling_shutter.hpp"

#include <optional>
#include <span>
#include <vector>

namespace palpable::vision {

/// Pose of a camera: world_from_camera.
using CameraPose = Transform<WorldFrame, CameraFrame>;

/// A scene point and the track from which it was triangulated.
struct StructurePoint {
  Point<WorldFrame> position;
  std::size_t track = 0;
};

/// Structure and motion: camera poses and scene points. The scale is arbitrary, since the size of a
/// scene cannot be determined without a known length.
struct CameraMotion {
  /// The given camera, or one with the estimated focal length.
  Pinhole camera;
  /// One for each frame; nullopt for frames whose points do not determine it.
  std::vector<std::optional<CameraPose>> poses;
  std::vector<StructurePoint> points;
  /// RMS reprojection error, px.
  double reprojection_rms_px = 0.0;
  /// The poses are those of the middle of each frame's readout, and reprojection errors are those of places
  /// that were moved there (without_rolling_shutter()).
  Readout readout = {};
};

struct BatchMotionOptions {
  /// The next keyframe is the frame in which points have moved by this share of the picture's width, 0.002 …
  /// 0.5.
  double keyframe_step = 0.03;
  /// Where fewer of a keyframe's points are in the next one, a frame between becomes a keyframe, share, 0
  /// … 1.
  double keyframe_kept = 0.7;
  /// Least triangulation angle of a point between two frames, degrees, 0.1 … 20.
  double least_angle_deg = 1.5;
  /// A larger reprojection error means a wrong track, px, 0.1 … 20.
  double outlier_px = 2.0;
  /// Scale of the Huber loss, px, 0.05 … 10: larger errors count linearly.
  double robust_px = 0.7;
  /// Least number of points for a frame's pose, 6 … 1000.
  int least_points = 20;
  /// A keyframe whose pose lost its points is added again at most this many times, 1 … 100.
  int most_attempts = 8;
  /// Everything is refined after this many added keyframes, 1 … 100 …
  int refined_every = 3;
  /// … with at most this many iterations; 1 … 1000 as the two below.
  int early_iterations = 5;
  /// Of the refinement when all keyframes are added, and of each of the two after it.
  int keyframe_iterations = 20, final_iterations = 30;
  /// Poses from which on an unknown focal length is refined, 2 … 100: with fewer views a longer one cannot be
  /// distinguished from a greater distance.
  int views_for_focal_length = 4;
  /// 1: the readout of a rolling shutter is estimated …
  int rolling_shutter = 1;
  /// … and used if it lowers the robust squared errors by this share, 0 … 1.
  double least_readout_gain = 0.02;
};
std::vector<Parameter> parameters_of(BatchMotionOptions& options);

/// What is known of a video's camera.
struct VideoCamera {
  /// If the focal length is unknown, an approximate one.
  Pinhole pinhole;
  bool focal_length_known = true;
};

/// Computes the poses of all frames and the positions of the tracked points by bundle adjustment (Triggs et
/// al. 2000). It starts with the pair of keyframes that determines most points; further keyframes are added
/// by their known points. Then all variables are refined together with a robust loss, including an unknown
/// focal length, and the readout of a rolling shutter where it lowers the errors. `frame_numbers`: of each
/// frame, in the video; equal steps are equal times. The world frame is the camera of the first keyframe,
/// scaled so that the median depth of the points is 1. Long work: reports progress, polls cancel. Errors:
/// usage for options out of range; invalid_input if the camera hardly moved, only rotated, or too few points
/// are tracked; interrupted.
Result<CameraMotion> motion_from_tracks(std::span<const PointTrack> tracks,
                                        std::span<const int> frame_numbers, const VideoCamera& camera,
                                        const BatchMotionOptions& options, const Work& work);

}  // namespace palpable::vision
