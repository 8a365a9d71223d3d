// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace palpable::session {

/// Position and heading of an explorer in the scene, seen from above. In the egocentric frame of reference
/// (Moustakas et al. 2007; the exocentric one looks from outside) the hand's frame moves and turns with the
/// explorer: x right, y ahead, z up from the base.
struct ExplorerPose {
  double x_m = 0.0;
  double y_m = 0.0;
  /// 0 faces up the scene (+y); turning left is positive.
  double heading_rad = 0.0;
};

/// A pose that holds from a time on.
struct WalkStep {
  double t_s = 0.0;
  ExplorerPose pose;
};

/// Metres; origin at the explorer's feet on the base: x right, y ahead, z up.
struct ExplorerFrame;

Transform<SceneFrame, ExplorerFrame> scene_from_explorer(const ExplorerPose& pose);
/// The placement of a device whose workspace centre moves with the explorer; scale and height are those of
/// `laid_out`.
Transform<SceneFrame, DeviceFrame> with_explorer(const Transform<SceneFrame, DeviceFrame>& laid_out,
                                                 const ExplorerPose& pose);

/// Number of steps up to the time `t_s`. The times of the walk must increase.
std::size_t steps_by(std::span<const WalkStep> walk, double t_s);
/// The pose at a time: that of the last step that is not later; before the first step, the first. `walk`
/// must not be empty, and its times must increase.
const ExplorerPose& pose_at(std::span<const WalkStep> walk, double t_s);

/// Checks a walk. The error is a sentence with the number of the first invalid step: no steps, values that
/// are not finite, farther than 1000 m from the centre, or not later than the previous step.
Result<void> check_walk(std::span<const WalkStep> walk);

/// A sentence for speech: "You stand 20 millimetres right of and 5 millimetres below the middle, facing
/// left."
std::string words_of(const ExplorerPose& pose);

}  // namespace palpable::session
