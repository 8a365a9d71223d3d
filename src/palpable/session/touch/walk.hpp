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

/// Where an explorer stands in the scene, seen from above, and which way they face. In the egocentric frame
/// of reference (Moustakas et al. 2007 distinguish it from the exocentric one, which looks on from outside)
/// the hand's frame stands and turns with the explorer: y is ahead, x to the right, z up from the base as
/// ever.
struct Stance {
  double x_m = 0.0;
  double y_m = 0.0;
  /// 0 faces up the scene (+y), to the left is positive.
  double heading_rad = 0.0;
};

/// An explorer stands so from that time on.
struct WalkStep {
  double t_s = 0.0;
  Stance stance;
};

/// Metres about the explorer's feet on the base: x to the right, y ahead, z up.
struct ExplorerFrame;

Transform<SceneFrame, ExplorerFrame> scene_from_explorer(const Stance& stance);
/// A device whose middle goes with the explorer; its scale and height in the scene stay as laid out.
Transform<SceneFrame, DeviceFrame> with_explorer(const Transform<SceneFrame, DeviceFrame>& laid_out,
                                                 const Stance& stance);

/// How many steps have been taken by then. The walk's times rise.
std::size_t steps_by(std::span<const WalkStep> walk, double t_s);
/// The last step that is not later; before the first, the first. `walk` is not empty, its times rise.
const Stance& stance_at(std::span<const WalkStep> walk, double t_s);

/// The first fault, as a sentence with the step's number: no steps, one that is not finite, farther than
/// 1000 m from the middle, or not later than the one before.
Result<void> check_walk(std::span<const WalkStep> walk);

/// "You stand 20 millimetres right of and 5 millimetres below the middle, facing left." For speech.
std::string words_of(const Stance& stance);

}  // namespace palpable::session
