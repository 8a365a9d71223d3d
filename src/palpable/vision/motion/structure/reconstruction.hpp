// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/structure/bundle.hpp"
#include "palpable/vision/motion/structure/first_pair.hpp"
#include "palpable/vision/motion/structure/triangulation.hpp"

#include <optional>
#include <set>
#include <span>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// Incremental structure from motion: the known poses of frames and points of tracks. It refers to the
/// tracks, which must outlive it.
class Reconstruction {
 public:
  /// `frames` in increasing order: the keyframes, until add_all_frames().
  Reconstruction(std::span<const PointTrack> tracks, std::vector<int> frames, const VideoCamera& camera,
                 const BatchMotionOptions& options);

  void begin(const FirstPair& pair, const Work& work);
  /// The frame without a pose that observes most known points; -1 if no frame observes enough of them.
  int next_keyframe() const;
  /// False if its points do not determine its pose; it is tried again after another frame was added.
  bool add_keyframe(int index);
  /// Triangulates the tracks that enough frames with poses observe.
  void triangulate_all();
  /// Refines everything, removes points with large errors, and poses that too few points are left for.
  void refine(int iterations, const Work& work);
  /// Finds the readout of a rolling shutter and removes its effect from the tracks, if that lowers the
  /// errors enough. `frame_numbers`: of all frames, in the video.
  void find_readout(std::span<const int> frame_numbers, int iterations, const Work& work);
  /// Computes the pose of every frame, not only of keyframes, from the points that it observes.
  void add_all_frames(int frame_count, const Work& work);
  /// The result in the frame of the first camera with a pose, scaled to a median depth of 1.
  CameraMotion result() const;

 private:
  /// What is known, and which pose and track each part of it belongs to.
  struct Parts {
    Bundle bundle;
    std::vector<int> pose_index;
    std::vector<std::size_t> point_tracks;
  };
  Parts parts() const;
  void drop_unsupported_poses();
  std::vector<std::size_t> seen_points(int frame) const;
  const BundlePose* nearest_pose(int index) const;
  std::optional<BundlePose> pose_from_points(int frame, const BundlePose* guess) const;
  std::vector<PosedObservation> observations_of(std::size_t track) const;

  std::span<const PointTrack> tracks_;
  /// The tracks without rolling shutter, if there is one.
  std::vector<PointTrack> own_tracks_;
  Readout readout_;
  std::vector<int> frames_;
  Pinhole camera_;
  bool focal_length_known_ = true;
  BatchMotionOptions options_;
  /// Scale of the robust loss, px: about 1.2 standard deviations of the errors after the last refinement
  /// (their median length), at most that of the options.
  double robust_px_ = 0.0;
  std::vector<std::optional<BundlePose>> poses_;
  /// How often each keyframe was tried.
  std::vector<int> attempts_;
  std::vector<std::optional<std::array<double, 3>>> points_;
  std::set<int> refused_;
};

}  // namespace palpable::vision
