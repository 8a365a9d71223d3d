// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/structure/bundle.hpp"
#include "palpable/vision/motion/structure/recursive_motion.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// Where a track is seen in the current frame.
struct TrackPlace {
  std::size_t track = 0;
  ImagePoint place;
};

/// A point of the filter's state.
struct FilteredPoint {
  std::size_t track = 0;
  Vec3 world;
  /// Standard deviation of its inverse depth, relative to it.
  double relative_spread = 0.0;
  int misses = 0;
};

/// The state of one frame (Azarbayejani & Pentland 1995) and its covariance: turn, translation, relative
/// inverse focal length, and an inverse depth for each point along the line of sight with which it was added.
class MotionFilter {
 public:
  MotionFilter(const VideoCamera& camera, const FilterMotionOptions& options);
  ~MotionFilter();
  MotionFilter(const MotionFilter&) = delete;
  MotionFilter& operator=(const MotionFilter&) = delete;

  /// Camera from world. Its covariance stays.
  void set_pose(const BundlePose& camera_from_world);
  BundlePose pose() const;
  /// The given one, or with the focal length found so far.
  Pinhole camera() const;

  /// A point seen at `place` from the current pose, with this inverse depth.
  void add_point(const TrackPlace& seen, double inverse_depth, double relative_spread);
  void remove_point(std::size_t track);
  std::vector<FilteredPoint> points() const;
  /// In the current camera; 1 without points.
  double median_inverse_depth() const;
  /// The mean inverse depth of the current points becomes certain.
  void fix_scale();

  /// The camera moved for so many frames.
  void predict(int frames);
  /// Corrects the state by the current frame's places; returns how many were used. Below
  /// FilterMotionOptions::least_points nothing changes but the points' misses.
  int update(std::span<const TrackPlace> seen);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace palpable::vision
