// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/frame.hpp"
#include "palpable/vision/motion/point_tracks.hpp"

#include <optional>
#include <span>
#include <vector>

namespace palpable::vision {

/// Where a camera was, as the world sees it.
using CameraPose = Transform<WorldFrame, CameraFrame>;

/// A point of the scene and the track that it was computed from.
struct StructurePoint {
  Point<WorldFrame> position;
  std::size_t track = 0;
};

/// Structure and motion: where the camera was, and where the points are. Unit scale: without a known length
/// nothing says how large a filmed scene is.
struct CameraMotion {
  /// As given, or with the focal length that was found.
  Pinhole camera;
  /// One for each frame; not given for frames whose points do not determine it.
  std::vector<std::optional<CameraPose>> poses;
  std::vector<StructurePoint> points;
  /// Root mean square distance between seen and projected places, px.
  double reprojection_rms_px = 0.0;
};

struct BatchMotionOptions {
  /// A keyframe follows when points have moved by this share of the picture's width, 0.002 … 0.5.
  double keyframe_step = 0.03;
  /// Least angle between the lines of sight of a point in two frames, degrees, 0.1 … 20.
  double least_angle_deg = 1.5;
  /// Errors larger than this count as wrong tracks, px, 0.1 … 20.
  double outlier_px = 2.0;
  /// Errors above it count linearly (Huber), px, 0.05 … 10.
  double robust_px = 0.7;
  /// A frame's pose needs so many points, 6 … 1000.
  int least_points = 20;
};
std::vector<Parameter> parameters_of(BatchMotionOptions& options);

/// What is known of a video's camera.
struct VideoCamera {
  /// Where the focal length is not known: one of the right order.
  Pinhole pinhole;
  bool focal_length_known = true;
};

/// Poses of all frames and positions of the tracked points by bundle adjustment (Triggs et al. 2000): the
/// pair of keyframes that determines most points begins, further keyframes join by their known points, all is
/// refined together with a robust loss, an unknown focal length too. The world is the camera of the first
/// keyframe, in which the median depth of the points is one. Long work: reports progress, polls cancel.
/// Errors: usage for options out of range; invalid_input where the camera hardly moved, only turned, or too
/// few points are followed; interrupted.
Result<CameraMotion> motion_from_tracks(std::span<const PointTrack> tracks, int frame_count,
                                        const VideoCamera& camera, const BatchMotionOptions& options,
                                        const Work& work);

}  // namespace palpable::vision
