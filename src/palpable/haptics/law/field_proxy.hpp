// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/haptics/law/surface_proxy.hpp"
#include "palpable/haptics/law/texture_touch.hpp"
#include "palpable/models/field/distance_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace palpable::haptics {

/// A point that follows the hand and never enters a solid. All zero = a new touch.
struct FieldProxy {
  enum class Phase : std::uint8_t { fresh, free, touching };
  Vec3 place_m;
  /// Where the hand was in the last tick.
  Vec3 hand_m;
  /// The surface's outward unit normal at place_m; only when touching.
  Vec3 normal;
  /// As SurfaceProxy::step_share.
  double step_share = 0.0;
  Phase phase = Phase::fresh;
  bool slipping = false;
};

/// `proxy` on a solid: a spring from the hand to a point that stays on the surface and slides towards the
/// hand under a friction cone (Zilles & Salisbury 1995; on implicit surfaces Salisbury & Tarr 1997), and a
/// damper along the normal. The point moves along the surface only, in steps shorter than a cell or half of
/// the hand's own way, and each must bring it nearer to the hand; free, it walks by the distance itself: it
/// never jumps to the far side of a thin wall.
template <models::DistanceSurface Surface>
class FieldProxyLaw : public ContactLaw<Surface> {
 public:
  struct State {
    FieldProxy proxy;
    TextureTouch texture;
  };

  FieldProxyLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, double radius_m,
                Textures textures = Textures({}))
      : ContactLaw<Surface>(std::move(surface), std::move(materials)),
        radius_m_(radius_m),
        textures_(std::move(textures)) {}

  LawOutput evaluate(const Hand& hand, State& state) const noexcept {
    FieldProxy& proxy = state.proxy;
    // What is felt is what the proxy touches, wherever the hand has gone under the surface.
    const Vec3 from = proxy.phase == FieldProxy::Phase::fresh ? hand.position.v : proxy.place_m;
    const Contact& under = this->materials().contact(this->materials().label_at(from.x, from.y));
    follow(hand.position.v, {under.static_friction, under.dynamic_friction}, proxy);
    LawOutput output;
    output.has_proxy = true;
    output.proxy.v = proxy.place_m;
    output.label = this->materials().label_at(proxy.place_m.x, proxy.place_m.y);
    output.contact = proxy.phase == FieldProxy::Phase::touching;
    output.stored_J = 0.0;
    if (!output.contact) {
      state.texture.share = 0.0;
      return output;
    }
    const Contact& contact = this->materials().contact(output.label);
    const Vec3 stretch = proxy.place_m - hand.position.v;
    output.stored_J = 0.5 * contact.stiffness_N_per_m * squared_norm(stretch);
    output.spring_N.v = contact.stiffness_N_per_m * stretch;
    const double damper = contact.damping_Ns_per_m * dot(hand.velocity_m_per_s.v, proxy.normal);
    const double spring = contact.stiffness_N_per_m * dot(stretch, proxy.normal);
    // The damper may take all of the push along the normal, and never pulls.
    output.force_N.v =
        contact.stiffness_N_per_m * stretch - std::min(damper, std::max(spring, 0.0)) * proxy.normal;
    if (textures_.any())
      add_texture(hand, textures_.of(output.label),
                  {proxy.place_m, proxy.normal, dot(stretch, proxy.normal), contact.stiffness_N_per_m},
                  on_solid, state.texture, output);
    return output;
  }

 private:
  static constexpr int kMaxEvaluations = 3;
  /// Nearer than this to where it belongs, the proxy rests: 0.05 mN at 500 N/m.
  static constexpr double kTolerance_m = 1e-7;

  models::FieldSample sample(Vec3 place_m) const noexcept {
    models::FieldSample s = this->surface().sample(place_m);
    s.distance_m -= radius_m_;
    return s;
  }

  /// From a place near the surface onto it, along the gradient (Newton's method).
  bool settle(Vec3& place_m, Vec3& normal, int& evaluations) const noexcept {
    while (evaluations > 0) {
      --evaluations;
      const models::FieldSample s = sample(place_m);
      const double length2 = squared_norm(s.gradient);
      if (!(length2 > 0.01)) return false;
      place_m -= (s.distance_m / length2) * s.gradient;
      normal = s.gradient / std::sqrt(length2);
      if (std::abs(s.distance_m) < 10.0 * kTolerance_m) return true;
    }
    return true;
  }

  void follow(Vec3 hand_m, Friction friction, FieldProxy& proxy) const noexcept {
    if (proxy.phase == FieldProxy::Phase::fresh) {
      // A hand that begins inside is taken to the nearest surface, once.
      proxy.place_m = hand_m;
      proxy.hand_m = hand_m;
      const models::FieldSample s = sample(hand_m);
      proxy.phase = FieldProxy::Phase::free;
      if (s.distance_m < 0.0) {
        int evaluations = 4 * kMaxEvaluations;
        if (settle(proxy.place_m, proxy.normal, evaluations)) proxy.phase = FieldProxy::Phase::touching;
      }
    }
    const double longest_m = std::max(this->surface().cell_m(), 0.5 * norm(hand_m - proxy.hand_m));
    proxy.hand_m = hand_m;
    int evaluations = kMaxEvaluations;
    while (evaluations > 0) {
      if (proxy.phase == FieldProxy::Phase::free && !fly(hand_m, proxy, evaluations)) return;
      if (evaluations <= 0 || slide(hand_m, longest_m, friction, proxy, evaluations)) return;
      proxy.phase = FieldProxy::Phase::free;
    }
  }

  /// Walks to the hand by the distance to the surface; true if it meets the surface.
  bool fly(Vec3 hand_m, FieldProxy& proxy, int& evaluations) const noexcept {
    while (evaluations > 0) {
      --evaluations;
      const Vec3 way = hand_m - proxy.place_m;
      const double left_m = norm(way);
      const models::FieldSample s = sample(proxy.place_m);
      if (left_m <= s.distance_m) {
        proxy.place_m = hand_m;
        return false;
      }
      // A field's gradient is within a few per cent of 1: a step of the whole distance stays outside.
      if (s.distance_m > 10.0 * kTolerance_m) {
        proxy.place_m += (0.97 * s.distance_m / left_m) * way;
        continue;
      }
      if (dot(s.gradient, way) >= 0.0 && s.distance_m >= -kTolerance_m) {
        // Off the surface: a short step on the free side, where the distance will say how far more.
        proxy.place_m += std::min(1.0, 0.25 * this->surface().cell_m() / left_m) * way;
        if (sample(proxy.place_m).distance_m >= 0.0) continue;
      }
      proxy.normal = unit(s.gradient);
      proxy.place_m -= s.distance_m * proxy.normal;
      proxy.phase = FieldProxy::Phase::touching;
      proxy.step_share = 0.0;
      return true;
    }
    return false;
  }

  /// Along the surface towards the hand; false if the hand stands on the free side.
  bool slide(Vec3 hand_m, double longest_m, Friction friction, FieldProxy& proxy,
             int& evaluations) const noexcept {
    double share = proxy.step_share > 0.0 ? proxy.step_share : 1.0;
    bool moved = false;
    const double coefficient = proxy.slipping ? friction.sliding : friction.at_rest;
    while (evaluations > 0) {
      const Vec3 d = hand_m - proxy.place_m;
      const double lifted = dot(d, proxy.normal);
      if (lifted > 0.0) return false;
      const Vec3 along = d - lifted * proxy.normal;
      const double along_m = norm(along);
      const double held_m = -lifted * (moved ? friction.sliding : coefficient);
      if (along_m <= held_m + kTolerance_m) break;
      const double step_m = std::min(share * (along_m - held_m), share * longest_m);
      Vec3 next = proxy.place_m + (step_m / along_m) * along;
      Vec3 normal = proxy.normal;
      int one = std::min(evaluations, 3);
      evaluations -= one;
      const bool settled = settle(next, normal, one);
      evaluations += one;
      if (!settled || squared_norm(hand_m - next) >= squared_norm(d)) {
        share *= 0.25;
        if (step_m < kTolerance_m) {
          share = 1.0;
          break;
        }
        continue;
      }
      share = std::min(1.0, 4.0 * share);
      moved = true;
      proxy.place_m = next;
      proxy.normal = normal;
    }
    proxy.step_share = share;
    proxy.slipping = moved;
    return true;
  }

  double radius_m_;
  Textures textures_;
};

}  // namespace palpable::haptics
