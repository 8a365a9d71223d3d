// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/nearest_step.hpp"
#include "palpable/models/relief.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::haptics {

/// A point that follows the hand but stays on or above a height field: free, it is the hand; in contact, it
/// stands on the surface at the place nearest to the hand that it can reach by sliding (god-object, Zilles &
/// Salisbury 1995; Ruspini 1997), held back by a friction cone. All zero = a new touch.
struct SurfaceProxy {
  enum class Phase : std::uint8_t { fresh, free, touching };

  /// On the surface (touching) or where the hand was last (free).
  Vec3 place_m;
  /// The surface at place_m; only when touching.
  models::CurvedSample surface;
  /// A height above the surface that the hand has for sure; only when free.
  double clearance_m = 0.0;
  Phase phase = Phase::fresh;
  /// The last tick moved the proxy against friction: the dynamic coefficient holds.
  bool slipping = false;
};

/// Coulomb's coefficients, >= 0, the dynamic one at most the static one.
struct Friction {
  double at_rest = 0.0;
  double sliding = 0.0;
};

/// Moves a SurfaceProxy over one height field. The solid lies below the surface. Every step of the proxy is
/// at most one pixel long and must bring it nearer to the hand, so it climbs or rounds a wall and never
/// passes through it; on the free way a wall cannot be missed below 16 pixels of hand movement a tick. At
/// most about 60 looks at the surface a tick, 1 ... 3 as a rule.
template <models::CurvedHeightField Surface>
class ProxyFollower {
 public:
  ProxyFollower(const Surface& surface, Friction friction) noexcept
      : surface_(surface), friction_(friction) {}

  /// One tick: the hand is at `hand_m`, finite.
  void follow(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
    if (proxy.phase == SurfaceProxy::Phase::fresh) begin(hand_m, proxy);
    // A slide may leave the surface and the free way meet it again, as from wall to wall of a narrow valley.
    for (int turn = 0; turn < kMostTurns; ++turn) {
      if (proxy.phase == SurfaceProxy::Phase::free && !fly(hand_m, proxy)) return;
      if (slide(hand_m, proxy)) return;
      if (turn + 1 < kMostTurns) {
        proxy.phase = SurfaceProxy::Phase::free;
        proxy.clearance_m = 0.0;
      }
    }
  }

 private:
  static constexpr int kMostTurns = 3;
  static constexpr int kMostSteps = 12;
  static constexpr int kMostStretches = 32;
  /// Nearer than this to where it belongs, the proxy rests: 0.05 mN at 500 N/m.
  static constexpr double kTolerance_m = 1e-7;

  /// A new touch at rest: under the surface it begins straight above the hand.
  void begin(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
    const models::CurvedSample s = surface_.curved_sample(hand_m.x, hand_m.y);
    proxy.slipping = false;
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

  /// Straight towards the hand; true if the surface is in the way: then the proxy rests where it was met.
  bool fly(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
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
    const int stretches =
        static_cast<int>(std::min<double>(kMostStretches, 1.0 + 2.0 * across / surface_.pixel_m()));
    double before = 0.0;
    double clearance = proxy.clearance_m;
    while (before < 1.0) {
      const double safe = clearance > 0.0 && shrinks > 0.0 ? clearance / shrinks : 0.0;
      const double next = std::min(1.0, before + std::max(1.0 / stretches, safe));
      const Vec3 p = from + next * way;
      const models::CurvedSample s = surface_.curved_sample(p.x, p.y);
      clearance = p.z - s.z_m;
      if (clearance < 0.0) {
        meet(from, way, before, next, proxy);
        return true;
      }
      before = next;
    }
    proxy.place_m = hand_m;
    proxy.clearance_m = clearance;
    return false;
  }

  /// Between `above` and `under` (fractions of the way) the surface is crossed: halves down to it and rests
  /// there.
  void meet(Vec3 from, Vec3 way, double above, double under, SurfaceProxy& proxy) const noexcept {
    constexpr int kHalvings = 6;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (above + under);
      const Vec3 p = from + middle * way;
      (p.z < surface_.curved_sample(p.x, p.y).z_m ? under : above) = middle;
    }
    const Vec3 p = from + above * way;
    rest(proxy, p.x, p.y, surface_.curved_sample(p.x, p.y));
    proxy.slipping = false;
  }

  /// Along the surface towards the hand; false if the hand stands on the free side of the surface where it
  /// ends.
  bool slide(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
    const double coefficient = proxy.slipping ? friction_.sliding : friction_.at_rest;
    bool moved = false;
    double shorter = 1.0;
    for (int step = 0; step < kMostSteps; ++step) {
      const models::CurvedSample& s = proxy.surface;
      const Vec3 d = hand_m - proxy.place_m;
      const double lifted = d.z - s.dzdx * d.x - s.dzdy * d.y;
      if (lifted > 0.0) return false;
      // Squares of the distance, of its part along the normal, and of the part along the surface.
      const double whole2 = squared_norm(d);
      const double normal2 = lifted * lifted / (1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy);
      const double along2 = std::max(0.0, whole2 - normal2);
      const double mu = moved ? friction_.sliding : coefficient;
      const double held = mu * std::sqrt(normal2);
      if (along2 <= (held + kTolerance_m) * (held + kTolerance_m)) break;
      const auto [dx, dy] = models::step_towards_nearest(d, s, shorter * (1.0 - held / std::sqrt(along2)),
                                                         shorter * surface_.pixel_m());
      const double x = proxy.place_m.x + dx;
      const double y = proxy.place_m.y + dy;
      const models::CurvedSample next = surface_.curved_sample(x, y);
      if (squared_norm(hand_m - Vec3{x, y, next.z_m}) >= whole2) {
        // Too far: the surface turned. A step that cannot be made shorter than the tolerance is none.
        shorter *= 0.5;
        if (std::hypot(dx, dy) < kTolerance_m) break;
        continue;
      }
      shorter = 1.0;
      moved = true;
      rest(proxy, x, y, next);
    }
    proxy.slipping = moved;
    return true;
  }

  const Surface& surface_;
  Friction friction_;
};

}  // namespace palpable::haptics
