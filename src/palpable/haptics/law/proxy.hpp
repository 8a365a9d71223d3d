// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/haptics/law/surface_proxy.hpp"
#include "palpable/haptics/law/texture_touch.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace palpable::haptics {

extern const LawDescription kProxyLaw;
/// The boundaries of a picture as grooves in a plate, rendered by `proxy`: passive, for exploring by touch
/// alone.
extern const LawDescription kGrooveLaw;

/// `proxy`: a spring from the hand to a surface-bound proxy that slides under a friction cone with static and
/// dynamic coefficient (the proxy is Hayward & Armstrong's w: it moves only when the cone is left, so nothing
/// drifts), and a damper along the surface's normal. The force never pulls the hand into the surface. A ball
/// of finite radius is a point on the relief dilated by it (relief_shaping.hpp).
template <models::CurvedHeightField Surface>
class ProxyLaw : public ContactLaw<Surface> {
 public:
  struct State {
    SurfaceProxy proxy;
    /// Follows the material under the proxy, so that a border between two is no kick.
    Contact contact;
    std::uint16_t label;
    bool knows_contact;
    TextureTouch texture;
  };

  ProxyLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, Textures textures = Textures({}))
      : ContactLaw<Surface>(std::move(surface), std::move(materials)), textures_(std::move(textures)) {}

  LawOutput evaluate(const Hand& hand, State& state) const noexcept {
    const Contact contact = contact_here(hand.dt_s, state);
    const ProxyFollower<Surface> follower(this->surface(),
                                          {contact.static_friction, contact.dynamic_friction});
    const Before before{state.proxy.place_m, state.proxy.phase == SurfaceProxy::Phase::touching};
    follower.follow(hand.position.v, state.proxy);
    LawOutput output;
    output.has_proxy = true;
    output.proxy.v = state.proxy.place_m;
    output.contact = state.proxy.holds_the_hand();
    output.label = state.label;
    output.stored_J = 0.0;
    if (output.contact) {
      output.force_N.v = force(hand, contact, state.proxy, before);
      const Vec3 stretched = state.proxy.place_m - hand.position.v;
      output.stored_J = 0.5 * contact.stiffness_N_per_m * squared_norm(stretched);
      output.spring_N.v = contact.stiffness_N_per_m * stretched;
      if (textures_.any()) add_texture_to(output, hand, contact, state);
    }
    return output;
  }

 private:
  static constexpr double kMaterialEase_s = 0.010;

  /// The proxy as the last tick left it.
  struct Before {
    Vec3 place_m;
    bool touching = false;
  };

  /// A surface's upward normal (-dz/dx, -dz/dy, 1), and one over its length's square.
  struct Upward {
    explicit Upward(const models::CurvedSample& s) noexcept
        : v{-s.dzdx, -s.dzdy, 1.0}, per_length2(1.0 / (1.0 + (s.dzdx * s.dzdx + s.dzdy * s.dzdy))) {}
    Vec3 v;
    double per_length2;
  };

  Contact contact_here(double dt_s, State& state) const noexcept {
    if (!this->materials().has_labels()) return this->materials().contact(0);
    state.label = this->materials().label_at(state.proxy.place_m.x, state.proxy.place_m.y);
    const Contact& here = this->materials().contact(state.label);
    const double share = state.knows_contact && state.proxy.phase == SurfaceProxy::Phase::touching
                             ? dt_s / (dt_s + kMaterialEase_s)
                             : 1.0;
    state.knows_contact = true;
    const auto ease = [share](double& value, double target) { value += share * (target - value); };
    ease(state.contact.stiffness_N_per_m, here.stiffness_N_per_m);
    ease(state.contact.damping_Ns_per_m, here.damping_Ns_per_m);
    ease(state.contact.static_friction, here.static_friction);
    ease(state.contact.dynamic_friction, here.dynamic_friction);
    return state.contact;
  }

  static Vec3 force(const Hand& hand, const Contact& contact, const SurfaceProxy& proxy,
                    const Before& before) noexcept {
    const Vec3 spring = contact.stiffness_N_per_m * (proxy.place_m - hand.position.v);
    if (proxy.phase != SurfaceProxy::Phase::touching) return spring;
    // The upward normal is left as long as it comes: the push does not wait for a root.
    const Upward up(proxy.surface);
    const double spring_up = dot(spring, up.v);
    const double damper_up = -contact.damping_Ns_per_m * dot(hand.velocity_m_per_s.v, up.v);
    // The damper may take the push away but never turns it into a pull. A proxy that the surface let go of in
    // this very tick is followed by the spring alone.
    const double pressing_up = spring_up > 0.0 ? std::max(0.0, spring_up + damper_up) : spring_up;
    return spring + ((pressing_up - spring_up) * up.per_length2) * up.v +
           grip(hand, contact, proxy, before, up, pressing_up);
  }

  void add_texture_to(LawOutput& output, const Hand& hand, const Contact& contact,
                      State& state) const noexcept {
    const SurfaceProxy& proxy = state.proxy;
    if (proxy.phase != SurfaceProxy::Phase::touching) {
      state.texture.share = 0.0;
      return;
    }
    const Upward up(proxy.surface);
    const Vec3 normal = std::sqrt(up.per_length2) * up.v;
    add_texture(
        hand, textures_.of(state.label),
        {proxy.place_m, normal, dot(proxy.place_m - hand.position.v, normal), contact.stiffness_N_per_m},
        on_plan, state.texture, output);
  }

  /// A proxy that friction holds is a spring in every direction, and like every spring in a sampled loop it
  /// needs a damper, or it makes energy. Where the proxy slides along with the hand nothing stretches and
  /// nothing is damped. Friction carries it: at most as much as the cone allows.
  static Vec3 grip(const Hand& hand, const Contact& contact, const SurfaceProxy& proxy, const Before& before,
                   const Upward& up, double pressing_up) noexcept {
    if (!before.touching) return {};
    const Vec3 v = hand.velocity_m_per_s.v;
    const Vec3 along = v - (dot(v, up.v) * up.per_length2) * up.v;
    const double speed = norm(along);
    const double held = speed - norm(proxy.place_m - before.place_m) / hand.dt_s;
    if (held <= 0.0) return {};
    const double pressing_N = pressing_up * std::sqrt(up.per_length2);
    const double drag_N = std::min(contact.damping_Ns_per_m * held, contact.static_friction * pressing_N);
    return (-drag_N / speed) * along;
  }

  Textures textures_;
};

}  // namespace palpable::haptics
