// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/haptics/law/tool_touch.hpp"
#include "palpable/haptics/law/touchable.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace palpable::haptics {

/// Where one of several probes is, and how it is turned, at a time.
struct ToolPose {
  double t_s = 0.0;
  /// Which probe, 0 ... kMaxProbes - 1.
  int probe = 0;
  /// Scale 1.
  Transform<SceneFrame, ToolFrame> scene_from_tool;
};

/// Fingers of more hands than a person has.
constexpr int kMaxProbes = 64;
/// Places of one tool.
constexpr std::size_t kMaxToolPlaces = 4096;

/// What one probe feels at one pose: the sums over its places, and of the first place in contact the label.
struct ToolOutput {
  Vector<SceneFrame> force_N;
  /// About the tool's origin, axes as the scene's.
  Vector<SceneFrame> torque_Nm;
  bool contact = false;
  std::uint16_t label = 0;
  /// Of a tool of one place whose law keeps a proxy.
  Point<SceneFrame> proxy;
  bool has_proxy = false;
};

/// The law's raw force and torque along a path of poses, which may be several probes' in turn: each place of
/// each probe is a touch of its own (its own state, its own proxy), whose force counts by its share. The
/// first pose of a probe starts its touches at rest; velocities are backward differences of the places.
/// Deterministic. Poses and places must be valid (check_poses, check_tool). Calls `each` for every pose in
/// order. With `penalty` on a field, undamped, this is tool_wrench().
void probe_tools(const Touchable& touchable, std::span<const ToolPlace> tool, std::span<const ToolPose> poses,
                 const std::function<void(const ToolPose&, const ToolOutput&)>& each);

/// The first fault, as a sentence with the sample's number: a pose that is not finite or of no probe, or not
/// later than its probe's last one.
Result<void> check_poses(std::span<const ToolPose> poses);
/// Between 1 and kMaxToolPlaces places, finite and within 1 m, with shares above 0 and at most 1000.
Result<void> check_tool(std::span<const ToolPlace> tool);

}  // namespace palpable::haptics
