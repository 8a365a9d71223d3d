// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/haptics/proxy/crossing_force.hpp"
#include "palpable/haptics/proxy/hand_over.hpp"
#include "palpable/haptics/proxy/proxy_force.hpp"
#include "palpable/haptics/proxy/surface_proxy.hpp"

#include <cmath>
#include <memory>
#include <utility>

namespace palpable::haptics {

extern const LawDescription kProxyLaw;
/// Makes the law for a relief, a field, or the grooves of contours.
MadeLaw make_proxy(const LawInput& in);

/// `proxy`: a spring from the hand to a proxy on the surface, which slides under a friction cone with a
/// static and a dynamic coefficient, and a damper along the surface normal. The proxy corresponds to w of
/// Hayward & Armstrong: it moves only when the hand leaves the cone, so nothing drifts. The force never pulls
/// the hand into the surface. A ball of finite radius is a point on the relief dilated by it
/// (relief_dilation.hpp).
template <models::BoundedHeightField Surface>
class ProxyLaw : public ContactLaw<Surface> {
 public:
  struct State {
    SurfaceProxy proxy;
    ContactMemory memory;
  };

  ProxyLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, Textures textures = Textures({}))
      : ContactLaw<Surface>(std::move(surface), std::move(materials)), textures_(std::move(textures)) {}

  [[gnu::flatten]] LawOutput evaluate(const Hand& hand, State& state) const noexcept {
    SurfaceProxy& proxy = state.proxy;
    const ProxyBefore before{proxy.place_m, proxy.phase == SurfaceProxy::Phase::touching, proxy.hand_m};
    const Contact& contact =
        eased_contact(this->materials(), proxy.place_m, before.touching, hand.dt_s, state.memory);
    const ProxyFollower<Surface> follower(this->surface(),
                                          {contact.static_friction, contact.dynamic_friction});
    if (!follower.is_held_slowly(hand.position.v, proxy))
      return output_otherwise(hand, contact, before, follower, state);
    // Apart from the other cases, so that the place and the surface are still in registers.
    SlideEnd end;
    if (follower.follow_slowly(hand.position.v, before, proxy, end)) [[likely]]
      return pushed(hand, contact, before, end.place_m,
                    {{-end.way.level[0], -end.way.level[1], -end.way.rise},
                     end.way.whole2,
                     {{-end.slope[0], -end.slope[1], 1.0}, end.steep2},
                     -end.lifted_m},
                    state);
    return output_after(hand, contact, before, state);
  }

  EnergyModel energy_model() const noexcept { return EnergyModel::spring; }

  HandOver hand_over(const State& state) const noexcept {
    return hand_over_of(state.proxy, unit(upward(state.proxy).v), state.memory);
  }

  TangentPlane tangent_plane(const Hand& hand, const State& state) const noexcept {
    const bool touches = state.proxy.holds_the_hand();
    const Vec3 at = touches ? state.proxy.place_m : hand.position.v;
    const models::HeightSample below = this->surface().sample(at.x, at.y);
    const bool is_eased = touches && state.memory.is_known;
    const std::uint16_t label = this->materials().label_at(at.x, at.y);
    return {true,
            {{at.x, at.y, touches ? at.z : below.z_m}},
            {unit(Vec3{-below.dzdx, -below.dzdy, 1.0})},
            is_eased ? state.memory.contact : this->materials().contact(label),
            textures_.of(label) != nullptr ? label : -1,
            device::LaidTexture::Onto::plan};
  }

  /// A proxy that was in contact moves vertically onto this surface and keeps its friction state. A free one
  /// keeps its position, unless it is below this surface.
  void take_over(const HandOver& from, State& state) const noexcept {
    if (!from.has_proxy) return;
    ProxyFollower<Surface>(this->surface(), {}).take_over(from, state.proxy);
    if (from.touching) state.memory = from.memory;
  }

 private:
  /// The output of a tick with a free proxy or a fast hand. A function of its own: with it, g++ has too few
  /// registers for the other ticks.
  [[gnu::noinline]] LawOutput output_otherwise(const Hand& hand, const Contact& contact,
                                               const ProxyBefore& before,
                                               const ProxyFollower<Surface>& follower,
                                               State& state) const noexcept {
    follower.follow(hand.position.v, state.proxy);
    return output_after(hand, contact, before, state);
  }

  /// The output after any tick.
  [[gnu::noinline]] LawOutput output_after(const Hand& hand, const Contact& contact,
                                           const ProxyBefore& before, State& state) const noexcept {
    if (state.proxy.holds_the_hand())
      return pushed(hand, contact, before, state.proxy.place_m, spring_of(state.proxy), state);
    LawOutput output = output_of(state);
    state.memory.texture.share = 0.0;
    if (state.proxy.crossed_m > 0.0) add_crossing(hand, contact, state.proxy, output);
    return output;
  }

  /// Along the normal.
  static Outward upward(const SurfaceProxy& proxy) noexcept {
    const models::Pair slope = proxy.surface.slope;
    return {{-slope[0], -slope[1], 1.0}, 1.0 + models::sum_of(slope * slope)};
  }
  /// The spring of a proxy in contact, and the direction in which its surface pushes. A proxy that waits in
  /// front of a wall, from which the hand is on the outer side of its tangent plane, is held by the wall: the
  /// direction is that of the spring.
  static ProxySpring spring_of(const SurfaceProxy& proxy) noexcept {
    const ProxySpring spring = proxy_spring(proxy.place_m - proxy.hand_m, upward(proxy));
    if (spring.out_m >= 0.0 || spring.square_m2 <= 0.0) return spring;
    return {spring.length_m, spring.square_m2, {spring.length_m, spring.square_m2}, spring.square_m2};
  }

  /// The output with a proxy in contact at `place_m`.
  [[gnu::always_inline]] LawOutput pushed(const Hand& hand, const Contact& contact, const ProxyBefore& before,
                                          Vec3 place_m, const ProxySpring& spring,
                                          State& state) const noexcept {
    LawOutput output = output_with(place_m, true, state.memory.label);
    output.force_N.v = proxy_force(hand, contact, place_m, before, spring);
    output.spring_N.v = contact.stiffness_N_per_m * spring.length_m;
    output.stored_J = 0.5 * contact.stiffness_N_per_m * spring.square_m2;
    if (textures_.any()) {
      const Outward up = upward(state.proxy);
      const Vec3 normal = (1.0 / std::sqrt(up.length2)) * up.v;
      add_texture(hand, textures_.of(state.memory.label),
                  {place_m, normal, dot(spring.length_m, normal), contact.stiffness_N_per_m}, on_plan,
                  state.memory.texture, output);
    }
    return output;
  }

  static LawOutput output_of(const State& state) noexcept {
    return output_with(state.proxy.place_m, state.proxy.holds_the_hand(), state.memory.label);
  }

  Textures textures_;
};

}  // namespace palpable::haptics
