// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_state.hpp"

#include "palpable/haptics/tick/servo_types.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpable::page {
namespace {

bool near(double a, double b, double limit) { return std::abs(a - b) < limit; }

bool same_place(const protocol::DevicePlace& a, const protocol::DevicePlace& b) {
  return near(a.x_m, b.x_m, 1e-6) && near(a.y_m, b.y_m, 1e-6) && near(a.z_m, b.z_m, 1e-6) &&
         near(a.turned_deg, b.turned_deg, 1e-2);
}

bool same_probe(const protocol::ProbeState& a, const protocol::ProbeState& b) {
  return a.probe == b.probe && a.page == b.page && a.contact == b.contact && a.label == b.label &&
         near(a.x_m, b.x_m, 1e-6) && near(a.y_m, b.y_m, 1e-6) && near(a.z_m, b.z_m, 1e-6) &&
         near(a.surface_m, b.surface_m, 1e-6) && near(a.fx_N, b.fx_N, 2e-3) && near(a.fy_N, b.fy_N, 2e-3) &&
         near(a.fz_N, b.fz_N, 2e-3);
}

}  // namespace

double surface_height_m(const models::Scene& scene, double x_m, double y_m) {
  return models::relief_of(scene)->sample(x_m, y_m).z_m;
}

protocol::ProbeState probe_state(const device::TouchSample& sample, const models::Scene& scene,
                                 double height_factor) {
  const Vec3 place = sample.position.v, force = sample.written_force_N.v;
  protocol::ProbeState state;
  state.probe = sample.probe;
  state.x_m = place.x;
  state.y_m = place.y;
  state.z_m = place.z;
  state.surface_m = height_factor * surface_height_m(scene, place.x, place.y);
  state.fx_N = force.x;
  state.fy_N = force.y;
  state.fz_N = force.z;
  state.contact = sample.has(haptics::flag::kContact);
  state.label = sample.label;
  return state;
}

protocol::DevicePlace device_place(const Transform<SceneFrame, DeviceFrame>& scene_from_device) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const Vec3 origin = scene_from_device.translation_m;
  const Vec3 first = scene_from_device.rotate({1.0, 0.0, 0.0});
  return {origin.x, origin.y, origin.z, kDegrees * std::atan2(first.y, first.x)};
}

bool nearly_equal(const protocol::State& a, const protocol::State& b) {
  return same_place(a.device, b.device) &&
         std::equal(a.probes.begin(), a.probes.end(), b.probes.begin(), b.probes.end(), same_probe);
}

Point<SceneFrame> pointer_place(const protocol::Pointer& pointer, const models::Scene& scene,
                                double height_factor, double radius_m) {
  const double surface_m = height_factor * surface_height_m(scene, pointer.x_m, pointer.y_m);
  return {Vec3{pointer.x_m, pointer.y_m, surface_m + radius_m - pointer.press_m}};
}

}  // namespace palpable::page
