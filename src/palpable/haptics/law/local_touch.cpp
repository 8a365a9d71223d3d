// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/local_touch.hpp"

#include "palpable/haptics/proxy/proxy_force.hpp"

#include <algorithm>

namespace palpable::haptics {

using Kind = device::LocalSurface::Kind;

EnergyModel LocalTouch::energy_model() const noexcept {
  if (kind_ == Kind::plane) return EnergyModel::spring;
  return kind_ == Kind::slope ? EnergyModel::weight : EnergyModel::none;
}

double LocalTouch::validity(Vec3 hand_m) const noexcept {
  const device::LocalSurface& surface = current_->surface;
  return std::clamp(2.0 - norm(hand_m - surface.hand.v) / surface.radius_m, 0.0, 1.0);
}

LawOutput LocalTouch::evaluate(const Hand& hand, TouchState& bytes) const noexcept {
  State& state = state_as<State>(bytes);
  if (current_->is_usable && current_->surface.kind == kind_)
    return kind_ == Kind::plane ? on_plane(hand, state) : on_slope(hand);
  state = {};
  LawOutput nothing;
  if (kind_ != Kind::force) nothing.stored_J = 0.0;
  return nothing;
}

double LocalTouch::rendered_depth_m(const Hand& hand, double depth_m, double stiffness_N_per_m,
                                    State& state) const noexcept {
  const device::LocalSurface& surface = current_->surface;
  const bool is_new = surface.read_at_s != state.read_at_s;
  if (is_new && state.has_plane) {
    const double last_m = std::max(0.0, dot(state.normal, state.place_m - hand.position.v) - state.lowered_m);
    const double now_m = std::max(0.0, depth_m - state.lowered_m);
    if (now_m > last_m)
      state.lowered_m = depth_m - last_m;
    else
      state.tank_J += 0.5 * stiffness_N_per_m * (last_m * last_m - now_m * now_m);
  }
  state.has_plane = true;
  state.place_m = surface.place.v;
  state.normal = surface.normal.v;
  state.read_at_s = surface.read_at_s;
  state.tank_J = std::min(kTank_J, state.tank_J * std::max(0.0, 1.0 - hand.dt_s / kTank_s));
  // Up to the hand it costs nothing.
  state.lowered_m = std::clamp(depth_m, 0.0, state.lowered_m);
  const double rendered_m = std::max(0.0, depth_m - state.lowered_m);
  const double wanted_m = std::min(state.lowered_m, kComesUp_m_per_s * hand.dt_s);
  const double push_N = stiffness_N_per_m * (rendered_m + wanted_m);
  const double risen_m = push_N > 0.0 ? std::min(wanted_m, state.tank_J / push_N) : 0.0;
  state.tank_J = std::max(0.0, state.tank_J - risen_m * push_N);
  state.lowered_m -= risen_m;
  return rendered_m + risen_m;
}

LawOutput LocalTouch::on_plane(const Hand& hand, State& state) const noexcept {
  const device::LocalSurface& surface = current_->surface;
  const Vec3 normal = surface.normal.v;
  const double valid = validity(hand.position.v);
  const Contact contact{valid * surface.stiffness_N_per_m, valid * surface.damping_Ns_per_m,
                        surface.static_friction, surface.dynamic_friction};
  const double depth_m = rendered_depth_m(hand, dot(normal, surface.place.v - hand.position.v),
                                          contact.stiffness_N_per_m, state);
  LawOutput output;
  output.stored_J = 0.0;
  output.has_proxy = true;
  output.proxy.v = hand.position.v;
  output.contact = depth_m > 0.0 && valid > 0.0;
  const ProxyBefore before{state.proxy_m, state.touching, state.hand_m};
  state.touching = output.contact;
  state.hand_m = hand.position.v;
  if (!output.contact) {
    state.slipping = false;
    return output;
  }
  // The frictionless goal, and how far behind it the proxy is: on a plane that moved it moves along.
  const Vec3 goal_m = hand.position.v + depth_m * normal;
  const Vec3 from_m = before.touching ? before.place_m : goal_m;
  const Vec3 behind_m = (from_m - goal_m) - dot(from_m - goal_m, normal) * normal;
  const double most_m = depth_m * (state.slipping ? contact.dynamic_friction : contact.static_friction);
  const double far_m = norm(behind_m);
  state.slipping = far_m > most_m;
  const double kept_m =
      state.slipping ? depth_m * std::min(contact.dynamic_friction, contact.static_friction) : far_m;
  state.proxy_m = far_m > 0.0 ? goal_m + (kept_m / far_m) * behind_m : goal_m;
  output.proxy.v = state.proxy_m;
  const Vec3 stretched = state.proxy_m - hand.position.v;
  output.spring_N.v = contact.stiffness_N_per_m * stretched;
  output.stored_J = 0.5 * contact.stiffness_N_per_m * squared_norm(stretched);
  output.force_N.v =
      proxy_force(hand, contact, state.proxy_m, before, proxy_spring(stretched, {normal, 1.0}));
  const double damped_W = -dot(output.force_N.v - output.spring_N.v, hand.velocity_m_per_s.v);
  state.tank_J += std::max(0.0, damped_W) * hand.dt_s +
                  contact.stiffness_N_per_m * kept_m * std::max(0.0, far_m - kept_m);
  return output;
}

LawOutput LocalTouch::on_slope(const Hand& hand) const noexcept {
  const device::LocalSurface& surface = current_->surface;
  const Vec3 force_N = validity(hand.position.v) * surface.force_N.v;
  LawOutput output;
  output.contact = true;
  output.force_N.v = force_N - surface.damping_Ns_per_m * hand.velocity_m_per_s.v;
  if (kind_ == Kind::force) return output;
  output.spring_N.v = force_N;
  output.stored_J = surface.stored_J - dot(surface.force_N.v, hand.position.v - surface.hand.v);
  return output;
}

}  // namespace palpable::haptics
