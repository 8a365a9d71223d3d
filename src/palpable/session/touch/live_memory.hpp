// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/material/material.hpp"
#include "palpable/session/touch/live_source.hpp"
#include "palpable/vision/mapping/camera_memory.hpp"
#include "palpable/vision/mapping/followed_view.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace palpable::session {

struct LiveMemoryOptions {
  vision::CameraMemoryOptions camera;
  vision::FollowedViewOptions view;
  /// The horizontal field of view of a camera that the source does not state, rad.
  double assumed_view_rad = 1.05;
};

/// The materials of a scene with memory: label 0 is what the camera sees now, the others what was seen some
/// time ago, with a texture of their own, named by that time.
std::vector<models::Material> memory_materials();
/// The label of what was seen so long ago, s >= 0: 1 … memory_materials().size() - 1.
std::uint8_t memory_label(double age_s);

/// Keeps what left a live camera's picture. The surface under the hand is shown from a place that rests while
/// the camera looks around (vision::FollowedView): what the camera sees now is drawn as it is seen from
/// there, and where it does not look the map fills in. One thread.
class LiveMemory {
 public:
  /// `options` within their ranges.
  explicit LiveMemory(const LiveMemoryOptions& options)
      : options_(options), memory_(options.camera), view_(options.view) {}

  /// What the camera sees now, from the view's place: depth in a picture of the camera's size, NaN where it
  /// does not look. `depth_m` is reduced by `reduction` from the frame's. While the camera's place is lost,
  /// the picture is as the camera sees it, and there is no memory.
  Raster<float> live_view(const LiveFrame& frame, const Raster<float>& depth_m, int reduction, double time_s);
  /// Fills unknown depths of live_view(), or a steadier version of it, from the map. The labels say which
  /// (memory_label()).
  Raster<std::uint8_t> fill(Raster<float>& depth_m);
  /// Adds the picture of the last live_view() to the map: after its surface was handed over, so that it does
  /// not come later for that.
  void learn();

  /// Share of the last view's pixels that are remembered.
  double remembered_share() const { return remembered_share_; }
  double map_mib() const { return static_cast<double>(memory_.map().bytes()) / (1 << 20); }
  /// Pictures whose place was not found.
  std::uint64_t lost() const { return lost_; }

 private:
  using Pose = vision::CameraMemory::Pose;

  LiveMemoryOptions options_;
  vision::CameraMemory memory_;
  vision::FollowedView view_;
  Raster<float> depth_m_;
  Pinhole camera_;
  /// Of the last picture; nullopt: lost.
  std::optional<Pose> pose_;
  Pose view_pose_;
  double time_s_ = 0.0;
  double remembered_share_ = 0.0;
  std::uint64_t lost_ = 0;
};

}  // namespace palpable::session
