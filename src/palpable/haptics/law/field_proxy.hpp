// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/haptics/proxy/hand_over.hpp"
#include "palpable/haptics/proxy/proxy_force.hpp"
#include "palpable/haptics/proxy/surface_proxy.hpp"
#include "palpable/models/field/distance_sample.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/models/field/outside_box.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace palpable::haptics {

/// The proxy of a touch on a solid: a point that follows the hand and never enters the solid. All zero = a
/// new touch.
struct FieldProxy {
  enum class Phase : std::uint8_t { fresh, free, touching };
  Vec3 place_m;
  /// The hand's position in the previous tick.
  Vec3 hand_m;
  /// The surface's outward unit normal at place_m; valid only while touching.
  Vec3 normal;
  /// A lower bound of the distance from place_m to the surface; valid only while free.
  double clearance_m = 0.0;
  /// As SurfaceProxy::step_share.
  double step_share = 0.0;
  /// Curvature of the surface along the last step, 1/m; positive where it is convex.
  double bend_per_m = 0.0;
  Phase phase = Phase::fresh;
  bool slipping = false;
  /// The last step of the tick was rejected, as in a crease, where the proxy is held by more than one face
  /// and the force does not point along the normal of one of them.
  bool blocked = false;
  /// A ball that is inside the solid: the hand in it needs no evaluation to know that it is not in the air.
  Vec3 inside_at_m;
  double inside_m = 0.0;
};

/// `proxy` on a solid: a spring from the hand to a point that stays on the surface and slides towards the
/// hand under a friction cone (Zilles & Salisbury 1995; on implicit surfaces Salisbury & Tarr 1997), with the
/// dampers of proxy_force().
/// In free air, the hand's whole path of the tick is checked. A segment is clear if the sum of the distances
/// at its two ends exceeds its length; segments shorter than half a cell need no check in between.
/// In contact, the point moves along the surface in steps of at most a cell or a quarter of the hand's path.
/// Each step must bring it nearer to the hand and must not end behind the middle of a wall. So it never jumps
/// to the far side of a wall that is at least as thick as the steps are long.
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
    FieldProxy& proxy = state.proxy;
    const bool is_new = proxy.phase == FieldProxy::Phase::fresh;
    const ProxyBefore before{proxy.place_m, proxy.phase == FieldProxy::Phase::touching, proxy.hand_m};
    // The material at the proxy is used, wherever the hand is below the surface.
    const Contact contact = eased_contact(this->materials(), is_new ? hand.position.v : proxy.place_m,
                                          before.touching, hand.dt_s, state.memory);
    follow(hand.position.v, {contact.static_friction, contact.dynamic_friction}, proxy);
    if (proxy.phase == FieldProxy::Phase::touching && has_left(hand.position.v, proxy))
      begin(hand.position.v, proxy);
    LawOutput output;
    output.has_proxy = true;
    output.proxy.v = proxy.place_m;
    output.label = state.memory.label;
    output.contact = proxy.phase == FieldProxy::Phase::touching;
    output.stored_J = 0.0;
    if (!output.contact) {
      state.memory.texture.share = 0.0;
      return output;
    }
    const Vec3 stretched = proxy.place_m - hand.position.v;
    output.force_N.v = proxy_force(hand, contact, proxy.place_m, before, outward(proxy, stretched));
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

  /// A proxy that was in contact moves to the nearest point of this surface, if it is near, and keeps its
  /// friction state. A free one keeps its position, unless it is inside this solid.
  void take_over(const HandOver& from, State& state) const noexcept {
    if (!from.has_proxy) return;
    FieldProxy& proxy = state.proxy;
    begin(from.place.v, proxy);
    proxy.hand_m = from.hand.v;
    proxy.slipping = from.slipping;
    if (!from.touching) return;
    int evaluations = kSettling;
    if (proxy.phase == FieldProxy::Phase::free && settle(proxy.place_m, proxy.normal, evaluations))
      proxy.phase = FieldProxy::Phase::touching;
    state.memory = from.memory;
  }

 private:
  /// Surface evaluations per tick: for a resting hand, additional ones per cell of movement, and the maximum.
  static constexpr int kEvaluations = 3;
  static constexpr double kPerCell = 1.25;
  static constexpr int kMaxEvaluations = 64;
  /// Evaluations to find the surface from a point near it, once.
  static constexpr int kSettling = 12;
  /// A last correction of at most this many cells is accepted.
  static constexpr double kOff = 0.05;
  /// Tolerance of points on the surface.
  static constexpr double kOn_m = 1e-6;
  /// Longest step as a share of the hand's path in the tick: a wall of that thickness is not stepped over.
  static constexpr double kLongestStep = 0.25;
  /// Limits of the factor by which curvature changes a step.
  static constexpr double kLeastBent = 0.4;
  static constexpr double kMostBent = 2.5;
  /// At this distance from its final position the proxy rests: 0.5 mN at 500 N/m.
  static constexpr double kTolerance_m = 1e-6;
  /// Shorter steps are not tried.
  static constexpr double kShortest_m = 1e-7;
  /// The share of a field's distance that is certainly clear: far from the surface its gradient may be a
  /// fifth longer than 1.
  static constexpr double kSafe = 0.8;
  /// Cosine between the proxy's normal and that of the far face of a wall.
  static constexpr double kFarFace = -0.5;
  /// Cosine between the normals of places half a cell apart on one face.
  static constexpr double kSameFace = 0.9;

  /// The direction in which the surface pushes. Where the proxy is held in a crease, it is that of the
  /// spring: a damper along the normal of one face would not damp the whole spring.
  static Outward outward(const FieldProxy& proxy, Vec3 stretched) noexcept {
    const double length_m = proxy.blocked ? norm(stretched) : 0.0;
    return {length_m > kTolerance_m ? stretched / length_m : proxy.normal, 1.0};
  }

  /// The distance of the probe's ball at a place of the scene.
  models::DistanceSample sample(Vec3 place_m) const noexcept {
    const models::FieldSample s = this->surface().sample({place_m});
    return {s.distance_m - radius_m_, s.gradient.v};
  }

  /// A lower bound of the distance `distance_m` that sample() gave at a place. Outside a field's box what it
  /// gives is an upper bound.
  double certain_m(Vec3 place_m, double distance_m) const noexcept {
    if constexpr (requires(const Surface& s) { s.origin_m(), s.size_m(); }) {
      const Vec3 place = place_m - this->surface().origin_m();
      const Vec3 size = this->surface().size_m();
      if (models::nearest_in_box(place, size) != place)
        return models::least_outside_box(place, size, distance_m + radius_m_) - radius_m_;
    }
    return distance_m;
  }

  /// Moves a point near the surface onto it along the gradient (Newton's method). `normal`: in, the normal at
  /// a nearby point, if known; out, the normal at the result. False if it does not converge: the field has no
  /// gradient there, or the point alternates between two faces of a crease.
  bool settle(Vec3& place_m, Vec3& normal, int& evaluations) const noexcept {
    double off_m = 0.0;
    while (evaluations > 0) {
      --evaluations;
      const models::DistanceSample s = sample(place_m);
      const double length2 = squared_norm(s.gradient);
      if (!(length2 > 0.01)) return false;
      place_m -= (s.distance_m / length2) * s.gradient;
      const Vec3 last = normal;
      normal = s.gradient / std::sqrt(length2);
      off_m = std::abs(s.distance_m);
      // The error after a correction is at most the correction times the change of the normal along it, which
      // is estimated by the change since the last point.
      if (off_m * std::min(1.0, norm(normal - last)) < kOn_m) return true;
    }
    return off_m < kOff * this->surface().cell_m();
  }

  /// Starts a touch. If the hand is inside the solid, the proxy is placed on the nearest surface point.
  void begin(Vec3 hand_m, FieldProxy& proxy) const noexcept {
    proxy.place_m = hand_m;
    proxy.hand_m = hand_m;
    proxy.phase = FieldProxy::Phase::free;
    const double distance_m = sample(hand_m).distance_m;
    proxy.clearance_m = std::max(0.0, certain_m(hand_m, distance_m));
    if (distance_m >= 0.0) return;
    int evaluations = kSettling;
    if (settle(proxy.place_m, proxy.normal, evaluations)) proxy.phase = FieldProxy::Phase::touching;
  }

  void follow(Vec3 hand_m, Friction friction, FieldProxy& proxy) const noexcept {
    if (proxy.phase == FieldProxy::Phase::fresh) begin(hand_m, proxy);
    const double cell_m = this->surface().cell_m();
    const double moved_m = norm(hand_m - proxy.hand_m);
    const double longest_m = std::max(cell_m, kLongestStep * moved_m);
    proxy.hand_m = hand_m;
    int evaluations =
        kEvaluations + static_cast<int>(std::min(kPerCell * moved_m / cell_m, 1.0 * kMaxEvaluations));
    const bool was_touching = proxy.phase == FieldProxy::Phase::touching;
    bool met = false;
    for (;;) {
      if (proxy.phase == FieldProxy::Phase::free) {
        met = fly(hand_m, proxy, evaluations);
        if (!met) break;
      }
      if (slide(hand_m, longest_m, friction, proxy, evaluations)) return;
      // The proxy alternates between the faces of a crease in every attempt.
      if (met && evaluations <= 0) return hold_in_crease(hand_m, proxy);
      proxy.phase = FieldProxy::Phase::free;
      proxy.clearance_m = 0.0;
    }
    if (proxy.place_m != hand_m) hold(hand_m, was_touching, proxy);
  }

  /// Called if the path to the hand needs more evaluations than a tick has. If the hand is inside, or was in
  /// contact and is not yet known to be free, the proxy moves to the surface point nearest to its present
  /// position, so it passes through nothing.
  void hold(Vec3 hand_m, bool was_touching, FieldProxy& proxy) const noexcept {
    if (!was_touching && sample(hand_m).distance_m >= 0.0) return;
    int evaluations = kSettling;
    if (settle(proxy.place_m, proxy.normal, evaluations)) proxy.phase = FieldProxy::Phase::touching;
  }

  /// In a crease the spring's direction is the normal.
  void hold_in_crease(Vec3 hand_m, FieldProxy& proxy) const noexcept {
    const Vec3 out = proxy.place_m - hand_m;
    const double length_m = norm(out);
    if (length_m > kTolerance_m && sample(hand_m).distance_m < 0.0) proxy.normal = out / length_m;
  }

  /// Moves the proxy straight to the hand. True if it meets the surface: then it stays at the first contact.
  /// Otherwise it is at the hand, or, after a jump, as far along the path as `evaluations` allow.
  bool fly(Vec3 hand_m, FieldProxy& proxy, int& evaluations) const noexcept {
    const Vec3 from = proxy.place_m;
    const Vec3 way = hand_m - from;
    const double length_m = norm(way);
    if (length_m < kSafe * proxy.clearance_m) {
      proxy.place_m = hand_m;
      proxy.clearance_m -= length_m / kSafe;
      return false;
    }
    // The surface cannot be hidden within half a cell.
    const double shortest = 0.5 * this->surface().cell_m() / std::max(length_m, 1e-12);
    double clear = 0.0;
    // First the whole path; then steps that are certainly clear by the distance (sphere tracing).
    double piece = 1.0;
    // Enough evaluations for the whole path.
    const double pieces = std::min(2.0 * length_m / this->surface().cell_m(), 1.0 * kMaxEvaluations);
    for (int left = std::max(evaluations, kEvaluations + static_cast<int>(pieces)); clear < 1.0 && left > 0;
         --left) {
      --evaluations;
      const double next = std::min(1.0, clear + piece);
      const Vec3 b = from + next * way;
      const models::DistanceSample s = sample(b);
      const double stretch_m = (next - clear) * length_m;
      const bool is_short = piece <= shortest;
      const double clear_m = std::max(0.0, certain_m(b, s.distance_m));
      if (s.distance_m >= 0.0 && (is_short || stretch_m < kSafe * (proxy.clearance_m + clear_m))) {
        clear = next;
        proxy.clearance_m = clear_m;
      } else if (is_short) {
        meet(from + clear * way, b, s, clear == 0.0, proxy);
        return true;
      }
      piece = std::max(0.99 * kSafe * proxy.clearance_m / length_m, shortest);
    }
    proxy.place_m = clear >= 1.0 ? hand_m : from + clear * way;
    return false;
  }

  /// Finds the contact between a, outside, and b, inside (with the sample `at_b`), at most half a cell apart.
  void meet(Vec3 a, Vec3 b, const models::DistanceSample& at_b, bool from_the_start,
            FieldProxy& proxy) const noexcept {
    // A path that begins on the surface leaves it first: there the rise replaces the distance.
    const double rise_m = dot(proxy.normal, b - a);
    const double clear_m =
        from_the_start && proxy.clearance_m <= 0.0 ? std::max(0.0, rise_m) : std::max(0.0, proxy.clearance_m);
    proxy.place_m = a + (clear_m / (clear_m - at_b.distance_m)) * (b - a);
    int evaluations = 3;
    settle(proxy.place_m, proxy.normal, evaluations);
    // In a crease the point found may belong to the other face; the face that was entered must stop the hand.
    const Vec3 entered = unit(at_b.gradient);
    if (dot(proxy.normal, entered) < kSameFace) proxy.normal = entered;
    proxy.phase = FieldProxy::Phase::touching;
    proxy.slipping = false;
    proxy.step_share = 0.0;
    proxy.bend_per_m = 0.0;
  }

  /// Whether the hand is known to be inside the solid, by an earlier evaluation.
  static bool is_known_inside(Vec3 hand_m, const FieldProxy& proxy) noexcept {
    return norm(hand_m - proxy.inside_at_m) < kSafe * proxy.inside_m;
  }

  /// The same as sample(), and remembers how far the hand is inside.
  models::DistanceSample sample_at_hand(Vec3 hand_m, FieldProxy& proxy) const noexcept {
    const models::DistanceSample s = sample(hand_m);
    proxy.inside_at_m = hand_m;
    proxy.inside_m = std::max(0.0, -s.distance_m);
    return s;
  }

  /// Whether the hand left the solid beside the proxy, as from a thin crest: friction must not hold it there,
  /// in the air. A hand on the far side of a thin wall is not beside the proxy.
  bool is_beside(Vec3 hand_m, FieldProxy& proxy) const noexcept {
    if (is_known_inside(hand_m, proxy)) return false;
    const models::DistanceSample s = sample_at_hand(hand_m, proxy);
    return s.distance_m > 0.0 && dot(s.gradient, proxy.normal) > kFarFace;
  }

  /// Whether the hand is in the air and nothing of the solid is between it and the proxy: a hand that was
  /// deep inside and came out elsewhere, while the proxy, which slides by a bounded way in a tick, is still
  /// on its way there. Sphere tracing, not closer than half a cell, where the surface cannot be hidden.
  bool has_left(Vec3 hand_m, FieldProxy& proxy) const noexcept {
    if (is_known_inside(hand_m, proxy)) return false;
    double distance_m = sample_at_hand(hand_m, proxy).distance_m;
    const double length_m = norm(proxy.place_m - hand_m);
    const Vec3 towards = (1.0 / std::max(length_m, kShortest_m)) * (proxy.place_m - hand_m);
    const double shortest_m = 0.5 * this->surface().cell_m();
    double clear_m = 0.0;
    for (int left = kMaxEvaluations; left > 0 && distance_m > 0.0; --left) {
      clear_m += std::max(kSafe * certain_m(hand_m + clear_m * towards, distance_m), shortest_m);
      if (clear_m >= length_m) return true;
      distance_m = sample(hand_m + clear_m * towards).distance_m;
    }
    return false;
  }

  /// Slides the proxy along the surface towards the hand; false if the hand is on the free side.
  bool slide(Vec3 hand_m, double longest_m, Friction friction, FieldProxy& proxy,
             int& evaluations) const noexcept {
    double share = proxy.step_share > 0.0 ? proxy.step_share : 1.0;
    bool moved = false;
    proxy.blocked = false;
    bool grips = true;
    const double coefficient = proxy.slipping ? friction.sliding : friction.at_rest;
    for (;;) {
      const Vec3 d = hand_m - proxy.place_m;
      const double lifted = dot(d, proxy.normal);
      if (lifted > 0.0) return false;
      if (evaluations <= 0) break;
      const Vec3 along = d - lifted * proxy.normal;
      const double along_m = norm(along);
      const double held_m = grips ? -lifted * (moved ? friction.sliding : coefficient) : 0.0;
      if (along_m <= held_m + kTolerance_m) {
        if (along_m > kTolerance_m && held_m > 0.0 && is_beside(hand_m, proxy)) {
          grips = false;
          continue;
        }
        proxy.blocked = false;
        break;
      }
      // Newton's step: the step in the tangent plane, corrected by the curvature.
      const double bent = std::clamp(1.0 + proxy.bend_per_m * lifted, kLeastBent, kMostBent);
      const double step_m = share * std::min((along_m - held_m) / bent, longest_m);
      const Vec3 aimed = proxy.place_m + (step_m / along_m) * along;
      Vec3 next = aimed;
      Vec3 normal = proxy.normal;
      int one = std::min(evaluations, 3);
      evaluations -= one;
      const bool settled = settle(next, normal, one);
      evaluations += one;
      // The correction led out of the solid in the direction of movement: the step ended behind the middle of
      // a wall.
      const Vec3 out = next - aimed;
      const bool through = dot(out, normal) > kOn_m && dot(out, along) > 0.0;
      // With friction, a proxy that is led beyond its place ahead of the hand stays there and pushes the hand
      // on.
      if (bent < 1.0 && held_m > 0.0 && dot(hand_m - next, along) < 0.0) {
        proxy.bend_per_m = 0.0;
        continue;
      }
      if (!settled || through || squared_norm(hand_m - next) >= squared_norm(d)) {
        // At a sharp edge the next face may see the hand, although no step on it is nearer.
        if (settled && !through && dot(hand_m - next, normal) > 0.0 &&
            norm(hand_m - next) <= norm(d) + kOn_m && is_beside(hand_m, proxy)) {
          proxy.place_m = next;
          proxy.normal = normal;
          return false;
        }
        proxy.blocked = true;
        share *= 0.25;
        if (step_m < kShortest_m) {
          share = 1.0;
          break;
        }
        continue;
      }
      proxy.blocked = false;
      share = std::min(1.0, 4.0 * share);
      moved = true;
      proxy.bend_per_m = dot(normal - proxy.normal, along) / (along_m * step_m);
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
