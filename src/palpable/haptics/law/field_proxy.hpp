// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/haptics/proxy/crossing_force.hpp"
#include "palpable/haptics/proxy/field_follower.hpp"
#include "palpable/haptics/proxy/hand_over.hpp"
#include "palpable/haptics/proxy/proxy_force.hpp"

#include <memory>
#include <utility>

namespace palpable::haptics {

/// `proxy` on a solid: a spring from the hand to a point that stays on the surface and slides towards the
/// hand under a friction cone (Zilles & Salisbury 1995; on implicit surfaces Salisbury & Tarr 1997), with the
/// dampers of proxy_force(). FieldFollower moves the point.
template <models::DistanceSurface Surface>
class FieldProxyLaw : public ContactLaw<Surface> {
 public:
  struct State {
    FieldProxy proxy;
    ContactMemory memory;
  };

  FieldProxyLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, double radius_m,
                Textures textures = Textures({}))
      : ContactLaw<Surface>(std::move(surface), std::move(materials)),
        radius_m_(radius_m),
        textures_(std::move(textures)) {}

  LawOutput evaluate(const Hand& hand, State& state) const noexcept {
    FoundInField found;
    return evaluate(hand, state, found);
  }
  /// The same. `found`: as the last tick of this touch on this surface left it.
  [[gnu::flatten]] LawOutput evaluate(const Hand& hand, State& state, FoundInField& found) const noexcept {
    FieldProxy& proxy = state.proxy;
    const bool is_new = proxy.phase == FieldProxy::Phase::fresh;
    const ProxyBefore before{proxy.place_m, proxy.holds_the_hand(), proxy.hand_m};
    // The material at the proxy is used, wherever the hand is below the surface.
    const Contact contact = eased_contact(this->materials(), is_new ? hand.position.v : proxy.place_m,
                                          before.touching, hand.dt_s, state.memory);
    const DilatedSolid<Surface> solid(this->surface(), radius_m_, found);
    FieldFollower<Surface>(solid, {contact.static_friction, contact.dynamic_friction})
        .follow(hand.position.v, proxy);
    LawOutput output = output_with(proxy.place_m, proxy.holds_the_hand(), state.memory.label);
    if (!output.contact) {
      state.memory.texture.share = 0.0;
      if (proxy.crossed_m > 0.0) add_crossing(hand, contact, proxy, output);
      return output;
    }
    const Vec3 stretched = proxy.place_m - hand.position.v;
    output.force_N.v =
        proxy_force(hand, contact, proxy.place_m, before, proxy_spring(stretched, outward(proxy, stretched)));
    output.stored_J = 0.5 * contact.stiffness_N_per_m * squared_norm(stretched);
    output.spring_N.v = contact.stiffness_N_per_m * stretched;
    if (textures_.any())
      add_texture(hand, textures_.of(output.label),
                  {proxy.place_m, proxy.normal, dot(stretched, proxy.normal), contact.stiffness_N_per_m},
                  on_solid, state.memory.texture, output);
    return output;
  }

  EnergyModel energy_model() const noexcept { return EnergyModel::spring; }

  HandOver hand_over(const State& state) const noexcept {
    return hand_over_of(state.proxy, state.proxy.normal, state.memory);
  }

  TangentPlane tangent_plane(const Hand& hand, const State& state) const noexcept {
    const bool touches = state.proxy.holds_the_hand();
    const Vec3 at = touches ? state.proxy.place_m : hand.position.v;
    const std::uint16_t label = this->materials().label_at(at.x, at.y);
    const Contact& here = this->materials().contact(label);
    const int texture = textures_.of(label) != nullptr ? label : -1;
    constexpr auto kOnto = device::LaidTexture::Onto::solid;
    if (touches)
      return {true,    {at}, {state.proxy.normal}, state.memory.is_known ? state.memory.contact : here,
              texture, kOnto};
    FoundInField found;
    const DilatedSolid<Surface> solid(this->surface(), radius_m_, found);
    const models::DistanceSample s = solid.sample(at);
    const double length = norm(s.gradient);
    // Where a field has no direction there is no surface near.
    constexpr double kShortest = 0.1;
    if (!(length > kShortest)) return {};
    const Vec3 normal = s.gradient / length;
    return {true, {at - (s.distance_m / length) * normal}, {normal}, here, texture, kOnto};
  }

  /// FieldFollower::take_over().
  void take_over(const HandOver& from, State& state) const noexcept {
    if (!from.has_proxy) return;
    FoundInField found;
    const DilatedSolid<Surface> solid(this->surface(), radius_m_, found);
    FieldFollower<Surface>(solid, {}).take_over(from, state.proxy);
    if (from.touching) state.memory = from.memory;
  }

 private:
  /// The direction in which the surface pushes. Where the proxy is held in a crease, it is that of the
  /// spring: a damper along the normal of one face would not damp the whole spring.
  static Outward outward(const FieldProxy& proxy, Vec3 stretched) noexcept {
    const double length_m = proxy.blocked ? norm(stretched) : 0.0;
    return {length_m > FieldSlide<Surface>::kTolerance_m ? stretched / length_m : proxy.normal, 1.0};
  }

  double radius_m_;
  Textures textures_;
};

}  // namespace palpable::haptics
