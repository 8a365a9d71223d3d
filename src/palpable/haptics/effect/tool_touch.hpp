// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/models/field/distance_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace palpable::haptics {

/// The frame of a held tool: metres, origin where the hand holds it.
struct ToolFrame;

/// A sample point of a tool's surface, and its share of the tool's stiffness.
struct ToolPlace {
  Point<ToolFrame> place;
  double share = 1.0;
};

/// Force and torque for a device with six degrees of freedom.
struct Wrench {
  Vector<SceneFrame> force_N;
  /// About the tool's origin, in the axes of the scene frame.
  Vector<SceneFrame> torque_Nm;
  /// The energy whose derivatives force and torque are.
  double stored_J = 0.0;
  bool contact = false;
};

/// `penalty` for an extended tool: each sample point is pushed out by -k min(D, 0) grad D; the torque of
/// these forces is taken about the tool's origin (Moustakas et al. 2007 claim six degrees of freedom but
/// define no torque). Force and torque are the exact derivatives of one energy, the sum of k D^2 / 2, so
/// without damping no movement or rotation generates energy. Undamped; scene_from_tool has scale 1. For
/// several tools (the five fingers of a glove) call it once for each on the same surface. Tick path: never
/// allocates.
template <models::DistanceSurface Surface>
Wrench tool_wrench(const Surface& surface, std::span<const ToolPlace> places,
                   const Transform<SceneFrame, ToolFrame>& scene_from_tool,
                   double stiffness_N_per_m) noexcept {
  Wrench wrench;
  for (const ToolPlace& tool : places) {
    const Point<SceneFrame> place = scene_from_tool * tool.place;
    const models::FieldSample s = surface.sample(place);
    if (!(s.distance_m < 0.0)) continue;
    const double stiffness = tool.share * stiffness_N_per_m;
    const Vector<SceneFrame> force = -stiffness * s.distance_m * s.gradient;
    wrench.contact = true;
    wrench.force_N += force;
    wrench.torque_Nm += cross(place - Point<SceneFrame>{scene_from_tool.translation_m}, force);
    wrench.stored_J += 0.5 * stiffness * s.distance_m * s.distance_m;
  }
  return wrench;
}

/// Sample points distributed evenly over a spherical cap around the tool's origin, about its -z axis: a
/// finger pad (8 mm, half_angle_rad about 1), or a cane's tip. Their shares sum to 1. radius_m > 0,
/// half_angle_rad in (0, pi], count >= 1.
inline std::vector<ToolPlace> cap_places(double radius_m, double half_angle_rad, std::size_t count) {
  std::vector<ToolPlace> places;
  places.reserve(count);
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double n = static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    // Equal heights have equal areas (Archimedes); consecutive points are rotated by the golden angle.
    const double down = 1.0 - (1.0 - std::cos(half_angle_rad)) * (static_cast<double>(i) + 0.5) / n;
    const double across = std::sqrt(std::max(0.0, 1.0 - down * down));
    const double turn = golden * static_cast<double>(i);
    places.push_back({{radius_m * Vec3{across * std::cos(turn), across * std::sin(turn), -down}}, 1.0 / n});
  }
  return places;
}

}  // namespace palpable::haptics
