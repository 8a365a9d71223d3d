// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/relief/nearest_step.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::haptics {

/// A point that follows the hand but stays on or above a height field: free, it is the hand; in contact, it
/// stands on the surface at the place nearest to the hand that it can reach by sliding (god-object, Zilles &
/// Salisbury 1995; Ruspini 1997), held back by a friction cone. All zero = a new touch.
struct SurfaceProxy {
  enum class Phase : std::uint8_t {
    fresh,
    /// Above the surface: at the hand, or, for a few ticks, on its way there.
    free,
    touching
  };

  Vec3 place_m;
  /// Where the hand was in the last tick.
  Vec3 hand_m;
  /// The surface at place_m; only when touching.
  models::CurvedSample surface;
  /// A height above the surface that place_m has for sure; only when free.
  double clearance_m = 0.0;
  Phase phase = Phase::fresh;
  /// The share of the longest step that last brought the proxy nearer; 0 = all of it. Kept from tick to tick:
  /// at a sharp kink a tick's few evaluations may not find a step that is short enough, and the proxy must
  /// not stay there.
  double step_share = 0.0;
  /// The last tick moved the proxy against friction: the dynamic coefficient holds.
  bool slipping = false;

  bool holds_the_hand() const noexcept { return phase == Phase::touching || place_m != hand_m; }
};

/// Coulomb's coefficients, >= 0, the dynamic one at most the static one.
struct Friction {
  double at_rest = 0.0;
  double sliding = 0.0;
};

/// Moves a SurfaceProxy over one height field; the solid lies below the surface. Sliding, each step is at
/// most a pixel (on slopes below 45 degrees and where it passes over no top, half of the hand's own movement
/// in the tick) and must bring the proxy nearer to the hand, so it climbs or rounds a wall and never passes
/// through it. A tick evaluations at the surface once or twice as a
/// rule, and kMaxEvaluations times at most, so that no tick is long: what is farther is reached in the next
/// ticks, at three pixels a tick or one and a half times the hand's own speed.
template <models::CurvedHeightField Surface>
class ProxyFollower {
 public:
  ProxyFollower(const Surface& surface, Friction friction) noexcept
      : surface_(surface), friction_(friction) {}

  /// One tick: the hand is at `hand_m`, finite.
  void follow(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
    if (proxy.phase == SurfaceProxy::Phase::fresh) begin(hand_m, proxy);
    const double longest_m = std::max(surface_.pixel_m(), 0.5 * norm(hand_m - proxy.hand_m));
    proxy.hand_m = hand_m;
    int evaluations = kMaxEvaluations;
    // A slide may leave the surface and the free way meet it again, as from wall to wall of a narrow valley.
    while (evaluations > 0) {
      if (proxy.phase == SurfaceProxy::Phase::free && !fly(hand_m, proxy, evaluations)) return;
      if (longest_m > surface_.pixel_m() ? slide<Steps::longer>(hand_m, longest_m, proxy, evaluations)
                                         : slide<Steps::pixels>(hand_m, longest_m, proxy, evaluations))
        return;
      proxy.phase = SurfaceProxy::Phase::free;
      proxy.clearance_m = 0.0;
    }
  }

 private:
  /// A slow hand's steps are never longer than a pixel, and need not be watched: its tick is the shorter.
  enum class Steps : std::uint8_t { pixels, longer };
  static constexpr int kMaxEvaluations = 3;
  /// In steps: so far ahead the memory's answer is there when the look is.
  static constexpr double kAhead = 3.0;
  /// 1 + slope^2 above which a step is a pixel at most: half-way up a wall a longer one might pass over its
  /// top.
  static constexpr double kSteep2 = 2.0;
  /// Nearer than this to where it belongs, the proxy rests: 0.05 mN at 500 N/m.
  static constexpr double kTolerance_m = 1e-7;

  /// A new touch at rest: under the surface it begins straight above the hand.
  void begin(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
    const models::CurvedSample s = surface_.curved_sample(hand_m.x, hand_m.y);
    proxy.slipping = false;
    proxy.hand_m = hand_m;
    if (hand_m.z < s.z_m) {
      rest(proxy, hand_m.x, hand_m.y, s);
    } else {
      proxy.place_m = hand_m;
      proxy.clearance_m = hand_m.z - s.z_m;
      proxy.phase = SurfaceProxy::Phase::free;
    }
  }

  static void rest(SurfaceProxy& proxy, double x_m, double y_m, const models::CurvedSample& s) noexcept {
    proxy.place_m = {x_m, y_m, s.z_m};
    proxy.surface = s;
    proxy.phase = SurfaceProxy::Phase::touching;
  }

  /// Straight towards the hand. True if the surface is in the way: then the proxy rests where it was met.
  /// Otherwise it is at the hand, or as far on the way as `evaluations` reach.
  bool fly(Vec3 hand_m, SurfaceProxy& proxy, int& evaluations) const noexcept {
    const Vec3 from = proxy.place_m;
    const Vec3 way = hand_m - from;
    const double across = std::hypot(way.x, way.y);
    // The height above the surface shrinks by no more than this all the way.
    const double shrinks = across * surface_.steepest_slope() + std::max(0.0, -way.z);
    if (proxy.clearance_m > shrinks) {
      proxy.clearance_m -= shrinks;
      proxy.place_m = hand_m;
      return false;
    }
    // The surface hides nothing within a pixel.
    const double stretch = std::min(1.0, surface_.pixel_m() / std::max(across, 1e-12));
    double before = 0.0;
    while (before < 1.0 && evaluations > 1) {
      --evaluations;
      const double safe = shrinks > 0.0 ? proxy.clearance_m / shrinks : 0.0;
      // A branch, not a maximum: the processor goes on to the next stretch before this one is known.
      const double next = std::min(1.0, safe > 2.0 * stretch ? before + safe : before + stretch);
      const Vec3 p = from + next * way;
      const double ahead = kAhead * (next - before);
      surface_.prefetch(p.x + ahead * way.x, p.y + ahead * way.y);
      const models::CurvedSample s = surface_.curved_sample(p.x, p.y);
      const double clearance = p.z - s.z_m;
      if (clearance < 0.0) {
        // By the secant; what is on either side of the crossing is less than a stretch away. A way that
        // begins on the surface rises from it at first: there the rise takes the place of the clearance, or
        // the proxy would meet the surface again where it stands, for ever.
        const double rise = way.z - proxy.surface.dzdx * way.x - proxy.surface.dzdy * way.y;
        const double clear =
            proxy.clearance_m > 0.0 ? proxy.clearance_m : std::max(0.0, rise * (next - before));
        const double met = before + (next - before) * clear / (clear - clearance);
        const Vec3 m = from + met * way;
        --evaluations;
        rest(proxy, m.x, m.y, surface_.curved_sample(m.x, m.y));
        proxy.slipping = false;
        return true;
      }
      before = next;
      proxy.clearance_m = clearance;
      proxy.place_m = p;
    }
    if (before >= 1.0) proxy.place_m = hand_m;
    return false;
  }

  /// Along the surface towards the hand; false if the hand stands on the free side of the surface where it
  /// ends.
  template <Steps kSteps>
  bool slide(Vec3 hand_m, double longest_m, SurfaceProxy& proxy, int& evaluations) const noexcept {
    // What one step waits for of the step before is kept short: the tick's length is this chain's.
    models::CurvedSample s = proxy.surface;
    Vec3 place = proxy.place_m;
    double mu = proxy.slipping ? friction_.sliding : friction_.at_rest;
    bool moved = false;
    bool leaves = false;
    double shorter = proxy.step_share > 0.0 ? proxy.step_share : 1.0;
    for (;;) {
      const Vec3 d = hand_m - place;
      const double lifted = d.z - (s.dzdx * d.x + s.dzdy * d.y);
      leaves = lifted > 0.0;
      if (leaves || evaluations <= 0) break;
      // Squares of the distance's parts along the normal and along the surface, both times `steep2`.
      const double whole2 = squared_norm(d);
      const double steep2 = 1.0 + (s.dzdx * s.dzdx + s.dzdy * s.dzdy);
      const double normal2 = lifted * lifted;
      const double along2 = std::max(0.0, whole2 * steep2 - normal2);
      const double held2 = mu * mu * normal2;
      const double near = kTolerance_m * std::sqrt(steep2) - mu * lifted;
      if (along2 <= near * near) break;
      const double reach_m = kSteps == Steps::longer && steep2 > kSteep2 ? surface_.pixel_m() : longest_m;
      const auto [dx, dy] =
          models::step_towards_nearest(d, s, shorter * (1.0 - std::sqrt(held2 / along2)), shorter * reach_m);
      const double x = place.x + dx;
      const double y = place.y + dy;
      --evaluations;
      surface_.prefetch(x + kAhead * dx, y + kAhead * dy);
      const models::CurvedSample next = surface_.curved_sample(x, y);
      // A step of more than a pixel may not pass over a top: what it hides may be a wall.
      const bool over_a_top = kSteps == Steps::longer &&
                              dx * dx + dy * dy > surface_.pixel_m() * surface_.pixel_m() &&
                              s.dzdx * dx + s.dzdy * dy > 0.0 && next.dzdx * dx + next.dzdy * dy < 0.0;
      if (over_a_top || squared_norm(hand_m - Vec3{x, y, next.z_m}) >= whole2) {
        // Too far: the surface turned. A step that cannot be made shorter than the tolerance is none.
        shorter *= 0.25;
        if (dx * dx + dy * dy < kTolerance_m * kTolerance_m) {
          shorter = 1.0;
          break;
        }
        continue;
      }
      shorter = std::min(1.0, 4.0 * shorter);
      moved = true;
      mu = friction_.sliding;
      place = {x, y, next.z_m};
      s = next;
    }
    if (moved) rest(proxy, place.x, place.y, s);
    if (leaves) return false;
    proxy.step_share = shorter;
    proxy.slipping = moved;
    return true;
  }

  const Surface& surface_;
  Friction friction_;
};

}  // namespace palpable::haptics
