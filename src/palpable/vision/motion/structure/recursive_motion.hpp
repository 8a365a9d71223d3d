// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/structure/camera_motion.hpp"

#include <span>

namespace palpable::vision {

/// The extended Kalman filter of motion_by_filter().
struct FilterMotionOptions {
  /// Standard deviation of a tracked place, px, 0.05 … 10.
  double noise_px = 0.5;
  /// Standard deviation of the camera's turn from one frame to the next, degrees, 0.01 … 20.
  double turn_deg = 1.0;
  /// Standard deviation of the camera's movement from one frame to the next, in distances of the points,
  /// 0.0001 … 1.
  double step = 0.02;
  /// Standard deviation of a new point's inverse depth, relative to it, 0.01 … 2.
  double depth_spread = 0.5;
  /// Standard deviation of a focal length that is not known, relative to it, 0.01 … 1.
  double focal_spread = 0.2;
  /// A place farther than so many standard deviations from where it is expected is not used, 1 … 20.
  double gate = 3.5;
  /// A point whose place is not used in so many frames in a row is lost, 1 … 100.
  int most_misses = 3;
  /// Points in the state at the same time, 10 … 500. The time rises with the cube of their number.
  int most_points = 150;
  /// Fewer points do not determine a frame's pose, 6 … 500.
  int least_points = 15;
  /// Linearisations of a frame's update (iterated filter), 1 … 20.
  int iterations = 3;
  /// 1: from the beginning to the end, after a start between the two frames of the pair. 2: and back to the
  /// beginning, with what is known then.
  int passes = 2;
  /// Points whose inverse depth is less certain are left out of the structure, relative, 0.001 … 1.
  double structure_spread = 0.05;
  /// Least angle between the lines of sight of a point of the structure, degrees, 0.1 … 20.
  double least_angle_deg = 1.5;
  /// Points of the structure with larger errors are left out, px, 0.1 … 20.
  double outlier_px = 2.0;
};
std::vector<Parameter> parameters_of(FilterMotionOptions& options);

/// Poses of all frames and positions of the tracked points by an extended Kalman filter, frame by frame
/// (Azarbayejani & Pentland 1995). The state is the camera's rotation (the filter estimates small turns of a
/// quaternion) and translation, and the inverse focal length where it is not known. For each followed point
/// it has one number: the inverse of its depth along its first line of sight. A place depends on the inverse
/// almost linearly (Civera et al. 2008). The mean inverse depth of the first points is fixed, which is the
/// scale. New tracks enter, the longest first; lost ones leave, and so do those whose places do not fit. The
/// filter begins with the relative pose of two frames, as motion_from_tracks(), whose refinement of
/// everything together is more accurate. Points that never were in the state are triangulated with the poses.
/// World, scale and errors as motion_from_tracks(). Long work: reports progress, polls cancel.
Result<CameraMotion> motion_by_filter(std::span<const PointTrack> tracks, int frame_count,
                                      const VideoCamera& camera, const FilterMotionOptions& options,
                                      const Work& work);

}  // namespace palpable::vision
