// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/local_touch.hpp"

#include <algorithm>
#include <cmath>

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
  if (current_->is_usable && current_->surface.kind == kind_) {
    LawOutput output = kind_ == Kind::plane ? on_plane(hand, state) : on_slope(hand);
    add_sent_pull(hand, bytes, output);
    return output;
  }
  state = {};
  // A plane that comes late, when the hand is already below it, begins where the hand is.
  state.has_plane = current_->is_usable && current_->surface.kind == Kind::free;
  LawOutput nothing;
  if (kind_ != Kind::force) nothing.stored_J = 0.0;
  add_sent_pull(hand, bytes, nothing);
  return nothing;
}

LocalTouch::Depth LocalTouch::depth_below(const Hand& hand, double depth_m, double stiffness_N_per_m,
                                          State& state) const noexcept {
  const device::LocalSurface& surface = current_->surface;
  Depth depth;
  if (surface.read_at_s != state.read_at_s && state.has_plane) {
    // A stiffer plane pushes as much as the last one where it is less deep.
    const double weaker = std::min(1.0, state.stiffness_N_per_m / stiffness_N_per_m);
    const double last_m = std::max(0.0, dot(state.normal, state.place_m - hand.position.v) - state.lowered_m);
    const double now_m = std::max(0.0, depth_m - state.lowered_m);
    if (now_m > weaker * last_m) state.lowered_m = depth_m - weaker * last_m;
    const double stretched_m = state.touching ? norm(state.proxy_m - hand.position.v) : 0.0;
    if (state.touching) depth.most_stretched_m = weaker * stretched_m;
    depth.held_J = 0.5 * state.stiffness_N_per_m * stretched_m * stretched_m;
  }
  state.has_plane = true;
  state.place_m = surface.place.v;
  state.normal = surface.normal.v;
  state.read_at_s = surface.read_at_s;
  state.stiffness_N_per_m = stiffness_N_per_m;
  state.tank_J = std::min(kTank_J, state.tank_J * std::max(0.0, 1.0 - hand.dt_s / kTank_s));
  // Up to the hand it costs nothing.
  state.lowered_m = std::clamp(depth_m, 0.0, state.lowered_m);
  const double rendered_m = std::max(0.0, depth_m - state.lowered_m);
  const double wanted_m = std::min(state.lowered_m, kComesUp_m_per_s * hand.dt_s);
  const double push_N = stiffness_N_per_m * (rendered_m + wanted_m);
  const double risen_m = push_N > 0.0 ? std::min(wanted_m, state.tank_J / push_N) : 0.0;
  state.tank_J = std::max(0.0, state.tank_J - risen_m * push_N);
  state.lowered_m -= risen_m;
  depth.rendered_m = rendered_m + risen_m;
  return depth;
}

double LocalTouch::slide(const Hand& hand, const Contact& contact, const Depth& depth,
                         const ProxyBefore& before, State& state) const noexcept {
  const Vec3 normal = current_->surface.normal.v;
  // The frictionless goal, and how far behind it the proxy is: on a plane that moved it moves along.
  const Vec3 goal_m = hand.position.v + depth.rendered_m * normal;
  const Vec3 from_m = before.touching ? before.place_m : goal_m;
  const Vec3 behind_m = (from_m - goal_m) - dot(from_m - goal_m, normal) * normal;
  const double friction = state.slipping ? contact.dynamic_friction : contact.static_friction;
  const double far_m = norm(behind_m);
  state.slipping = far_m > depth.rendered_m * friction;
  const double along_m =
      state.slipping ? depth.rendered_m * std::min(contact.dynamic_friction, contact.static_friction) : far_m;
  const double most2_m2 =
      depth.most_stretched_m * depth.most_stretched_m - depth.rendered_m * depth.rendered_m;
  const double kept_m = std::min(along_m, std::sqrt(std::max(0.0, most2_m2)));
  state.proxy_m = far_m > 0.0 ? goal_m + (kept_m / far_m) * behind_m : goal_m;
  return contact.stiffness_N_per_m * kept_m * (far_m - kept_m);
}

LawOutput LocalTouch::on_plane(const Hand& hand, State& state) const noexcept {
  const device::LocalSurface& surface = current_->surface;
  const Vec3 normal = surface.normal.v;
  const double valid = current_->account.plane_share() * validity(hand.position.v);
  const Contact contact{valid * surface.stiffness_N_per_m, valid * surface.damping_Ns_per_m,
                        surface.static_friction, surface.dynamic_friction};
  const Depth depth =
      depth_below(hand, dot(normal, surface.place.v - hand.position.v), contact.stiffness_N_per_m, state);
  LawOutput output;
  output.stored_J = 0.0;
  output.has_proxy = true;
  output.proxy.v = hand.position.v;
  output.contact = depth.rendered_m > 0.0 && valid > 0.0;
  const ProxyBefore before{state.proxy_m, state.touching, state.hand_m};
  state.touching = output.contact;
  state.hand_m = hand.position.v;
  if (!output.contact) {
    state.tank_J += depth.held_J;
    state.slipping = false;
    state.texture.share = 0.0;
    return output;
  }
  const double slid_J = slide(hand, contact, depth, before, state);
  output.proxy.v = state.proxy_m;
  const Vec3 stretched = state.proxy_m - hand.position.v;
  output.spring_N.v = contact.stiffness_N_per_m * stretched;
  output.stored_J = 0.5 * contact.stiffness_N_per_m * squared_norm(stretched);
  output.force_N.v =
      proxy_force(hand, contact, state.proxy_m, before, proxy_spring(stretched, {normal, 1.0}));
  const double damped_W = -dot(output.force_N.v - output.spring_N.v, hand.velocity_m_per_s.v);
  const double lost_J = depth.held_J > 0.0 ? depth.held_J - output.stored_J : slid_J;
  state.tank_J += std::max(0.0, damped_W) * hand.dt_s + std::max(0.0, lost_J);
  add_laid_texture(hand, {state.proxy_m, normal, depth.rendered_m, contact.stiffness_N_per_m}, state, output);
  return output;
}

void LocalTouch::add_laid_texture(const Hand& hand, const TexturedPlace& at, State& state,
                                  LawOutput& output) const noexcept {
  const device::LaidTexture& laid = current_->surface.texture;
  const Transform<SceneFrame, DeviceFrame> scene{laid.rotation, laid.translation_m, laid.scale};
  // The law computes in the scene's units; forces are the same there, and energies larger by the scale.
  Hand there;
  there.dt_s = hand.dt_s;
  there.velocity_m_per_s.v = laid.scale * scene.rotate(hand.velocity_m_per_s.v);
  LawOutput added;
  added.stored_J = 0.0;
  added.label = laid.number;
  added.force_N.v = scene.rotate(output.force_N.v);
  const Vec3 before_N = added.force_N.v;
  const TexturedPlace place{(scene * Point<DeviceFrame>{at.place_m}).v, scene.rotate(at.normal),
                            laid.scale * at.depth_m, at.stiffness_N_per_m / laid.scale};
  const auto* pattern = laid.number > 0 ? textures_.of(static_cast<std::uint16_t>(laid.number - 1)) : nullptr;
  if (laid.onto == device::LaidTexture::Onto::solid)
    add_texture(there, pattern, place, on_solid, state.texture, added);
  else
    add_texture(there, pattern, place, on_plan, state.texture, added);
  const auto device = scene.inverse();
  output.force_N.v += device.rotate(added.force_N.v - before_N);
  output.spring_N.v += device.rotate(added.spring_N.v);
  output.stored_J += added.stored_J / laid.scale;
}

void LocalTouch::add_sent_pull(const Hand& hand, TouchState& bytes, LawOutput& output) const noexcept {
  const device::LocalSurface& surface = current_->surface;
  State& state = state_as<State>(bytes);
  const double share = current_->account.pull_share() * validity(hand.position.v);
  const Vec3 change_N = share * surface.pull_N.v - state.pull_N;
  const double most_N = kPullChanges_N_per_s * hand.dt_s;
  const double size_N = norm(change_N);
  state.pull_N += size_N > most_N ? (most_N / size_N) * change_N : change_N;
  if (!output.contact) state.pull_N = {};
  add_pull(hand, state.pull_N, surface.pull_reserve_J, bytes.pull, output);
}

LawOutput LocalTouch::on_slope(const Hand& hand) const noexcept {
  const device::LocalSurface& surface = current_->surface;
  const Vec3 whole_N = validity(hand.position.v) * surface.force_N.v;
  // A hand that turns round gets the force before its velocity shows it.
  const double gives_W = dot(whole_N, hand.velocity_m_per_s.v) + speeds_up(hand, whole_N);
  const Vec3 force_N = current_->account.slope_share(gives_W) * whole_N;
  LawOutput output;
  output.contact = true;
  output.force_N.v = force_N - surface.damping_Ns_per_m * hand.velocity_m_per_s.v;
  if (kind_ == Kind::force) return output;
  output.spring_N.v = force_N;
  output.stored_J = surface.stored_J - dot(surface.force_N.v, hand.position.v - surface.hand.v);
  return output;
}

}  // namespace palpable::haptics
