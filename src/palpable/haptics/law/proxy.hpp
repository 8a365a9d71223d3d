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
    const Contact contact =
        eased_contact(this->materials(), proxy.place_m, before.touching, hand.dt_s, state.memory);
    const bool rests =
        ProxyFollower<Surface>(this->surface(), {contact.static_friction, contact.dynamic_friction})
            .follow(hand.position, proxy);
    // Apart from the other cases, so that the place and the surface are still in registers.
    if (rests) [[likely]]
      return pushed(hand, contact, before, upward(state.proxy), state);
    return output_after(hand, contact, before, state);
  }

  EnergyModel energy_model() const noexcept { return EnergyModel::spring; }

  HandOver hand_over(const State& state) const noexcept {
    const models::CurvedSample& s = state.proxy.surface;
    return hand_over_of(state.proxy, unit(Vec3{-s.dzdx, -s.dzdy, 1.0}), state.memory);
  }

  TangentPlane tangent_plane(const Hand& hand, const State& state) const noexcept {
    const bool touches = state.proxy.holds_the_hand();
    const Vec3 at = touches ? state.proxy.place_m : hand.position.v;
    const models::HeightSample below = this->surface().sample(at.x, at.y);
    const bool is_eased = touches && state.memory.is_known;
    return {
        true,
        {{at.x, at.y, touches ? at.z : below.z_m}},
        {unit(Vec3{-below.dzdx, -below.dzdy, 1.0})},
        is_eased ? state.memory.contact : this->materials().contact(this->materials().label_at(at.x, at.y))};
  }

  /// A proxy that was in contact moves vertically onto this surface and keeps its friction state. A free one
  /// keeps its position, unless it is below this surface.
  void take_over(const HandOver& from, State& state) const noexcept {
    if (!from.has_proxy) return;
    ProxyFollower<Surface>(this->surface(), {}).take_over(from, state.proxy);
    if (from.touching) state.memory = from.memory;
  }

 private:
  /// The output after any tick.
  [[gnu::noinline]] LawOutput output_after(const Hand& hand, const Contact& contact,
                                           const ProxyBefore& before, State& state) const noexcept {
    if (state.proxy.holds_the_hand()) return pushed(hand, contact, before, outward(state.proxy), state);
    LawOutput output = output_of(state);
    state.memory.texture.share = 0.0;
    if (state.proxy.crossed_m > 0.0) add_crossing(hand, contact, state.proxy, output);
    return output;
  }

  /// Along the normal.
  static Outward upward(const SurfaceProxy& proxy) noexcept {
    const models::CurvedSample& s = proxy.surface;
    return {{-s.dzdx, -s.dzdy, 1.0}, 1.0 / (1.0 + (s.dzdx * s.dzdx + s.dzdy * s.dzdy))};
  }
  /// The direction in which the surface pushes. A proxy that waits in front of a wall, from which the hand is
  /// on the outer side of its tangent plane, is held by the wall: the direction is that of the spring.
  static Outward outward(const SurfaceProxy& proxy) noexcept {
    const Outward up = upward(proxy);
    const Vec3 stretched = proxy.place_m - proxy.hand_m;
    const double square = squared_norm(stretched);
    return dot(stretched, up.v) < 0.0 && square > 0.0 ? Outward{stretched, 1.0 / square} : up;
  }

  /// The output with a proxy in contact whose surface pushes along `out`.
  [[gnu::always_inline]] LawOutput pushed(const Hand& hand, const Contact& contact, const ProxyBefore& before,
                                          const Outward& out, State& state) const noexcept {
    const SurfaceProxy& proxy = state.proxy;
    LawOutput output = output_of(state);
    const Vec3 stretched = proxy.place_m - hand.position.v;
    output.force_N.v = proxy_force(hand, contact, proxy.place_m, before, out);
    output.spring_N.v = contact.stiffness_N_per_m * stretched;
    output.stored_J = 0.5 * contact.stiffness_N_per_m * squared_norm(stretched);
    if (textures_.any()) {
      const Outward up = upward(proxy);
      const Vec3 normal = std::sqrt(up.per_length2) * up.v;
      add_texture(hand, textures_.of(state.memory.label),
                  {proxy.place_m, normal, dot(stretched, normal), contact.stiffness_N_per_m}, on_plan,
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
