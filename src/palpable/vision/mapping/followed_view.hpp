// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <optional>

namespace palpable::vision {

struct FollowedViewOptions {
  /// A camera that is farther away than this, or looks into a direction that differs by more, is followed.
  double far_m = 0.3;
  double far_rad = 0.35;
  /// Until it is as near as this.
  double near_m = 0.02;
  double near_rad = 0.02;
  /// The time in which the view's distance from the camera falls to 37 %, s.
  double time_s = 1.0;
};

/// A place in the world from which a moving camera's surroundings are shown: it stays where it is while the
/// camera looks around, so that what is at rest in the world rests in the view, and follows smoothly where
/// the camera goes on. One thread.
class FollowedView {
 public:
  using Pose = Transform<WorldFrame, CameraFrame>;
  explicit FollowedView(const FollowedViewOptions& options = {}) : options_(options) {}

  /// The view's pose `dt_s` >= 0 after the last one; at first that of the camera.
  const Pose& add(const Pose& world_from_camera, double dt_s);

 private:
  FollowedViewOptions options_;
  std::optional<Pose> view_;
  bool follows_ = false;
};

}  // namespace palpable::vision
