// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/effect/law_output.hpp"
#include "palpable/haptics/effect/material_map.hpp"
#include "palpable/haptics/effect/texture_touch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::haptics {

// The force between a hand and its proxy on a surface; the same for reliefs and fields.

/// The state of the material under the proxy of a touch. All zero = a new touch.
struct ContactMemory {
  /// Smoothed contact properties, so that a border between two materials gives no sudden force.
  Contact contact;
  std::uint16_t label = 0;
  bool is_known = false;
  TextureTouch texture{};
};

/// The contact properties at a proxy at `place_m`. In contact, the values follow the material within about 10
/// ms. Tick path.
inline Contact eased_contact(const MaterialMap& materials, Vec3 place_m, bool in_contact, double dt_s,
                             ContactMemory& memory) noexcept {
  constexpr double kEase_s = 0.010;
  if (!materials.has_labels()) return materials.contact(0);
  memory.label = materials.label_at(place_m.x, place_m.y);
  const Contact& here = materials.contact(memory.label);
  const double share = memory.is_known && in_contact ? dt_s / (dt_s + kEase_s) : 1.0;
  memory.is_known = true;
  const auto ease = [share](double& value, double target) { value += share * (target - value); };
  ease(memory.contact.stiffness_N_per_m, here.stiffness_N_per_m);
  ease(memory.contact.damping_Ns_per_m, here.damping_Ns_per_m);
  ease(memory.contact.static_friction, here.static_friction);
  ease(memory.contact.dynamic_friction, here.dynamic_friction);
  return memory.contact;
}

/// The proxy after the previous tick, and the hand in it.
struct ProxyBefore {
  Vec3 place_m;
  bool touching = false;
  Vec3 hand_m{};
};

/// An outward direction of any length, and the reciprocal of its squared length, so that the force needs no
/// square root.
struct Outward {
  Vec3 v;
  double per_length2 = 1.0;
};

/// Damper for a proxy that friction holds. Such a proxy is a spring in every direction; like every spring in
/// a sampled loop it needs a damper, or it generates energy. Where the proxy slides with the hand, nothing is
/// stretched and nothing is damped. The damping force is limited by the friction cone. Tick path.
inline Vec3 friction_damper(const Hand& hand, const Contact& contact, Vec3 place_m, const ProxyBefore& before,
                            const Outward& out, double pressing_out) noexcept {
  if (!before.touching || pressing_out <= 0.0) return {};
  const Vec3 v = hand.velocity_m_per_s.v;
  const Vec3 along = v - (dot(v, out.v) * out.per_length2) * out.v;
  // Mostly the proxy either kept up with the hand or did not move, which is known without roots.
  constexpr double kSurely = 1.0 - 1e-9;
  const double slid2 = squared_norm(place_m - before.place_m);
  const double speed2 = squared_norm(along);
  if (speed2 * (hand.dt_s * hand.dt_s) < kSurely * slid2) return {};
  const double speed = std::sqrt(speed2);
  const double held = slid2 > 0.0 ? speed - std::sqrt(slid2) / hand.dt_s : speed;
  if (held <= 0.0) return {};
  const double pressing_N = pressing_out * std::sqrt(out.per_length2);
  const double drag_N = std::min(contact.damping_Ns_per_m * held, contact.static_friction * pressing_N);
  return (-drag_N / speed) * along;
}

/// Damper for a spring whose direction turns against the movement, as under a crease, where the proxy stays
/// while the hand moves below it. There the spring is one along the surface too. The motors hold an earlier
/// direction, which pushes the hand on; the damper takes back what that gives, with the margin of the
/// stiffness limit (stability.cpp) and as far as dynamic friction does not. At most the push. Tick path.
inline Vec3 turning_damper(const Hand& hand, const Contact& contact, Vec3 place_m, const ProxyBefore& before,
                           const Outward& normal, double pressing_out) noexcept {
  constexpr double kMargin = 1.0 / 0.65;
  if (!before.touching || hand.acts_after_s <= 0.0 || pressing_out <= 0.0) return {};
  const Vec3 spring_m = place_m - hand.position.v;
  const Vec3 before_m = before.place_m - before.hand_m;
  const double squares = squared_norm(spring_m) + squared_norm(before_m);
  const double acts_s = kMargin * hand.acts_after_s;
  const double friction = contact.dynamic_friction;
  // The angle is at most twice the change over the sum of both lengths: mostly, friction is more.
  if (4.0 * acts_s * acts_s * squared_norm(spring_m - before_m) <=
      friction * friction * squares * (hand.dt_s * hand.dt_s))
    return {};
  const double length_m = norm(spring_m);
  const double length_before_m = norm(before_m);
  if (length_m <= 0.0 || length_before_m <= 0.0) return {};
  const Vec3 out = (1.0 / length_m) * spring_m;
  const Vec3 v = hand.velocity_m_per_s.v;
  const Vec3 along = v - dot(v, out) * out;
  const double speed = norm(along);
  if (speed <= 0.0) return {};
  const double turned_back = dot((1.0 / length_before_m) * before_m - out, along) / speed;
  const double share = std::min(1.0, acts_s / hand.dt_s * turned_back) - friction;
  if (share <= 0.0) return {};
  const double push_N =
      std::min(contact.stiffness_N_per_m * length_m, pressing_out * std::sqrt(normal.per_length2));
  return (-share * push_N / speed) * along;
}

/// The force of spring and dampers between the hand and a proxy at `place_m` on the surface. Tick path.
inline Vec3 proxy_force(const Hand& hand, const Contact& contact, Vec3 place_m, const ProxyBefore& before,
                        const Outward& out) noexcept {
  const Vec3 spring = contact.stiffness_N_per_m * (place_m - hand.position.v);
  const double spring_out = dot(spring, out.v);
  const double damper_out =
      -contact.damping_Ns_per_m * (dot(hand.velocity_m_per_s.v, out.v) + speeds_up(hand, out.v));
  // The damper may cancel the push but never turns it into a pull. If the surface released the proxy in this
  // tick, only the spring acts.
  const double pressing_out = spring_out > 0.0 ? std::max(0.0, spring_out + damper_out) : spring_out;
  return spring + ((pressing_out - spring_out) * out.per_length2) * out.v +
         friction_damper(hand, contact, place_m, before, out, pressing_out) +
         turning_damper(hand, contact, place_m, before, out, pressing_out);
}

}  // namespace palpable::haptics
