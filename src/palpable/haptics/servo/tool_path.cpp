// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/tool_path.hpp"

#include "palpable/haptics/tick/velocity.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace palpable::haptics {
namespace {

/// State of one probe between poses.
struct Probe {
  std::optional<double> last_s;
  /// One for each point of its tool.
  std::vector<TouchState> states;
  std::vector<Point<SceneFrame>> places;
  /// Of a sensor with a step; none without one.
  std::vector<VelocityEstimator> velocities;
};

/// The velocity at `place`: of the last way, or of the longest window that its sensor's step leaves open.
Vector<SceneFrame> velocity_at(Point<SceneFrame> place, std::size_t point, double dt_s, Probe& probe) {
  if (probe.velocities.empty()) return (1.0 / dt_s) * (place - probe.places[point]);
  return {probe.velocities[point].update({place.v}, dt_s).v};
}

ToolOutput evaluate(const Touchable& touchable, std::span<const ToolPlace> tool, const ToolPose& pose,
                    double sensor_step_m, Probe& probe) {
  // Tick length of a first sample, which has no previous one.
  constexpr double kFirstTick_s = 0.001;
  const bool first = !probe.last_s;
  if (first) {
    probe.states.resize(tool.size());
    probe.places.resize(tool.size());
    if (sensor_step_m > 0.0) probe.velocities.assign(tool.size(), VelocityEstimator(sensor_step_m));
  }
  ToolOutput sum;
  Hand hand;
  hand.dt_s = first ? kFirstTick_s : pose.t_s - *probe.last_s;
  hand.rotation = pose.scene_from_tool.rotation;
  for (std::size_t i = 0; i < tool.size(); ++i) {
    hand.position = pose.scene_from_tool * tool[i].place;
    const Vector<SceneFrame> velocity = velocity_at(hand.position, i, hand.dt_s, probe);
    hand.velocity_m_per_s = first ? Vector<SceneFrame>{} : velocity;
    probe.places[i] = hand.position;
    const LawOutput place = touchable.evaluate(hand, probe.states[i]);
    const Vector<SceneFrame> force = tool[i].share * place.force_N;
    sum.force_N += force;
    sum.torque_Nm += cross(hand.position - Point<SceneFrame>{pose.scene_from_tool.translation_m}, force) +
                     tool[i].share * place.torque_Nm;
    if (i == 0 || (place.contact && !sum.contact)) sum.label = place.label;
    sum.contact = sum.contact || place.contact;
    sum.has_proxy = place.has_proxy && tool.size() == 1;
    sum.proxy = place.proxy;
  }
  probe.last_s = pose.t_s;
  return sum;
}

}  // namespace

void probe_tools(const Touchable& touchable, std::span<const ToolPlace> tool, std::span<const ToolPose> poses,
                 const std::function<void(const ToolPose&, const ToolOutput&)>& each, double sensor_step_m) {
  std::vector<Probe> probes(kMaxProbes);
  for (const ToolPose& pose : poses)
    each(pose, evaluate(touchable, tool, pose, sensor_step_m, probes[static_cast<std::size_t>(pose.probe)]));
}

Result<void> check_poses(std::span<const ToolPose> poses) {
  if (poses.empty()) return invalid_input("the path has no samples");
  std::vector<std::optional<double>> last_s(kMaxProbes);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const ToolPose& pose = poses[i];
    const auto& r = pose.scene_from_tool.rotation;
    const std::string sample = "sample " + std::to_string(i + 1);
    if (!std::isfinite(pose.t_s) || !is_finite(pose.scene_from_tool.translation_m) ||
        !std::all_of(r.begin(), r.end(), [](double v) { return std::isfinite(v); }))
      return invalid_input(sample + " is not finite");
    if (pose.probe < 0 || pose.probe >= kMaxProbes)
      return invalid_input(sample + " is of a probe that is none of 0 to " + std::to_string(kMaxProbes - 1));
    auto& last = last_s[static_cast<std::size_t>(pose.probe)];
    if (last && !(pose.t_s > *last))
      return invalid_input(sample + " is not later than the one before of the same probe");
    last = pose.t_s;
  }
  return {};
}

Result<void> check_tool(std::span<const ToolPlace> tool) {
  if (tool.empty() || tool.size() > kMaxToolPlaces)
    return invalid_input("a tool has 1 to " + std::to_string(kMaxToolPlaces) + " places");
  for (std::size_t i = 0; i < tool.size(); ++i)
    if (!(norm(tool[i].place.v) <= 1.0) || !(tool[i].share > 0.0 && tool[i].share <= 1000.0))
      return invalid_input("place " + std::to_string(i + 1) +
                           " is farther than 1 m from the tool's origin, or its share is not above 0 and at "
                           "most 1000");
  return {};
}

}  // namespace palpable::haptics
