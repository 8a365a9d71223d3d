// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/haptics/effect/tool_touch.hpp"
#include "palpable/haptics/law/touchable.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace palpable::haptics {

/// Pose of one of several probes at a time.
struct ToolPose {
  double t_s = 0.0;
  /// Number of the probe, 0 ... kMaxProbes - 1.
  int probe = 0;
  /// A rigid transform: scale 1.
  Transform<SceneFrame, ToolFrame> scene_from_tool;
};

/// Greatest number of probes in a file.
constexpr int kMaxProbes = 64;
/// Greatest number of sample points of one tool.
constexpr std::size_t kMaxToolPlaces = 4096;

/// Result of one probe at one pose: force and torque summed over its sample points, and the label of the
/// first point in contact.
struct ToolOutput {
  Vector<SceneFrame> force_N;
  /// About the tool's origin, in the axes of the scene frame.
  Vector<SceneFrame> torque_Nm;
  bool contact = false;
  std::uint16_t label = 0;
  /// The proxy position; only for a tool of one point whose law has a proxy.
  Point<SceneFrame> proxy;
  bool has_proxy = false;
};

/// Evaluates the law's force and torque along a sequence of poses, which may alternate between probes;
/// without caps, ramps or passivity control. Each point of each probe is a separate touch (its own state and
/// proxy), whose force is multiplied by its weight. The first pose of a probe starts its touches at rest;
/// velocities are backward differences of the points, or, with `sensor_step_m` above 0, those that a touch
/// computes of readings in such steps (VelocityEstimator). Deterministic. Poses and points must be valid
/// (check_poses, check_tool). `each` is called for every pose in order. With the undamped law `penalty` on a
/// field, the result equals tool_wrench().
void probe_tools(const Touchable& touchable, std::span<const ToolPlace> tool, std::span<const ToolPose> poses,
                 const std::function<void(const ToolPose&, const ToolOutput&)>& each,
                 double sensor_step_m = 0.0);

/// Checks poses: finite, a valid probe number, and later than the previous pose of the same probe. The error
/// is a sentence with the number of the first invalid sample.
Result<void> check_poses(std::span<const ToolPose> poses);
/// Checks a tool: 1 to kMaxToolPlaces points, finite and within 1 m, with weights above 0 and at most 1000.
Result<void> check_tool(std::span<const ToolPlace> tool);

}  // namespace palpable::haptics
