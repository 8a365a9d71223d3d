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

/// The contact properties at a proxy at `place_m`, of the map or in `memory`. In contact, the values follow
/// the material within about 10 ms. Tick path.
inline const Contact& eased_contact(const MaterialMap& materials, Vec3 place_m, bool in_contact, double dt_s,
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

/// An outward direction of any length, and its squared length, so that the force needs no root of it.
struct Outward {
  Vec3 v;
  double length2 = 1.0;
};

/// The spring from a hand to its proxy, and the direction in which the surface pushes.
struct ProxySpring {
  Vec3 length_m;
  double square_m2;
  Outward out;
  /// The length times the outward direction.
  double out_m;
};
inline ProxySpring proxy_spring(Vec3 length_m, const Outward& out) noexcept {
  return {length_m, squared_norm(length_m), out, dot(length_m, out.v)};
}

/// Damper for a proxy that friction holds, as a damping, N·s/m: it acts against the hand's velocity along the
/// surface. Such a proxy is a spring in every direction; like every spring in a sampled loop it needs a
/// damper, or it generates energy. Where the proxy slides with the hand, nothing is stretched and nothing is
/// damped. The damping force is limited by the friction cone. `speed_out`: the hand's velocity times the
/// outward direction; `slid2_m2`: the square of the proxy's way in this tick. Tick path.
inline double friction_damping(const Hand& hand, const Contact& contact, double slid2_m2, const Outward& out,
                               double speed_out, double pressing_out) noexcept {
  // The squared way of the hand along the surface in a tick, times that of the outward direction's length.
  const double way2 =
      (squared_norm(hand.velocity_m_per_s.v) * out.length2 - speed_out * speed_out) * (hand.dt_s * hand.dt_s);
  // Mostly the proxy either kept up with the hand or did not move. The least is a way of 1e-18 m.
  constexpr double kLeast = 1e-36;
  const double slid2 = slid2_m2 * out.length2;
  if (way2 <= slid2 || way2 < kLeast) return 0.0;
  const double per_way = std::sqrt(1.0 / way2);
  const double held = 1.0 - std::sqrt(slid2) * per_way;
  const double most = contact.static_friction * pressing_out * hand.dt_s * per_way;
  return std::min(contact.damping_Ns_per_m * held, most);
}

/// What turning_damper() needs, for a hand that friction does not slow enough.
[[gnu::noinline]] inline Vec3 turning_damper_beyond_friction(const Hand& hand, const Contact& contact,
                                                             const ProxySpring& spring, Vec3 before_m,
                                                             double pressing_out, double acts_s) noexcept {
  const double length_m = std::sqrt(spring.square_m2);
  const double length_before_m = norm(before_m);
  if (length_m <= 0.0 || length_before_m <= 0.0) return {};
  const Vec3 out = (1.0 / length_m) * spring.length_m;
  const Vec3 v = hand.velocity_m_per_s.v;
  const Vec3 along = v - dot(v, out) * out;
  const double speed = norm(along);
  if (speed <= 0.0) return {};
  const double turned_back = dot((1.0 / length_before_m) * before_m - out, along) / speed;
  const double share = std::min(1.0, acts_s / hand.dt_s * turned_back) - contact.dynamic_friction;
  if (share <= 0.0) return {};
  const double push_N =
      std::min(contact.stiffness_N_per_m * length_m, pressing_out / std::sqrt(spring.out.length2));
  return (-share * push_N / speed) * along;
}

/// Damper for a spring whose direction turns against the movement, as under a crease, where the proxy stays
/// while the hand moves below it. There the spring is one along the surface too. The motors hold an earlier
/// direction, which pushes the hand on; the damper takes back what that gives, with the margin of the
/// stiffness limit (stability.cpp) and as far as dynamic friction does not. At most the push. Tick path.
inline Vec3 turning_damper(const Hand& hand, const Contact& contact, const ProxySpring& spring,
                           const ProxyBefore& before, double pressing_out) noexcept {
  constexpr double kMargin = 1.0 / 0.65;
  if (hand.acts_after_s <= 0.0) return {};
  const Vec3 before_m = before.place_m - before.hand_m;
  const double squares = spring.square_m2 + squared_norm(before_m);
  const double acts_s = kMargin * hand.acts_after_s;
  const double friction = contact.dynamic_friction;
  // The angle is at most twice the change over the sum of both lengths: mostly, friction is more.
  if (4.0 * acts_s * acts_s * squared_norm(spring.length_m - before_m) <=
      friction * friction * squares * (hand.dt_s * hand.dt_s)) [[likely]]
    return {};
  return turning_damper_beyond_friction(hand, contact, spring, before_m, pressing_out, acts_s);
}

/// The force of spring and dampers between the hand and a proxy at `place_m` on the surface. Tick path.
inline Vec3 proxy_force(const Hand& hand, const Contact& contact, Vec3 place_m, const ProxyBefore& before,
                        const ProxySpring& spring) noexcept {
  const Outward& out = spring.out;
  const Vec3 v = hand.velocity_m_per_s.v;
  const double per_length2 = 1.0 / out.length2;
  const double spring_out = contact.stiffness_N_per_m * spring.out_m;
  const double speed_out = dot(v, out.v);
  const double damper_out = -contact.damping_Ns_per_m * (speed_out + speeds_up(hand, out.v));
  // The damper may cancel the push but never turns it into a pull. If the surface released the proxy in this
  // tick, only the spring acts.
  const double pressing_out = spring_out > 0.0 ? std::max(0.0, spring_out + damper_out) : spring_out;
  double drag = 0.0;
  Vec3 turning;
  if (before.touching && pressing_out > 0.0) [[likely]] {
    drag =
        friction_damping(hand, contact, squared_norm(place_m - before.place_m), out, speed_out, pressing_out);
    turning = turning_damper(hand, contact, spring, before, pressing_out);
  }
  // Along the surface, the velocity is v less its part along the outward direction.
  const double out_N = (pressing_out - spring_out + drag * speed_out) * per_length2;
  return contact.stiffness_N_per_m * spring.length_m - drag * v + out_N * out.v + turning;
}

}  // namespace palpable::haptics
