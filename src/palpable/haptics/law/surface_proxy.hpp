// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/models/relief/height_bounds.hpp"
#include "palpable/models/relief/nearest_step.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::haptics {

/// A point that follows the hand but stays on or above a height field: free, it is the hand; in contact, it
/// is on the surface at the place nearest to the hand that it can reach by sliding (god-object, Zilles &
/// Salisbury 1995; Ruspini 1997), held back by a friction cone. All zero = a new touch.
struct SurfaceProxy {
  enum class Phase : std::uint8_t {
    fresh,
    /// Above the surface, at the hand (or, after a jump that is too long for one tick, on its way there).
    free,
    touching
  };

  Vec3 place_m;
  /// Where the hand was in the last tick.
  Vec3 hand_m;
  /// The surface at place_m; only when touching.
  models::CurvedSample surface;
  /// A height above the surface that place_m has for certain; only when free.
  double clearance_m = 0.0;
  Phase phase = Phase::fresh;
  /// The share of the longest step that last brought the proxy nearer; 0 = all of it. Kept from tick to tick:
  /// at a sharp kink a tick's few evaluations may not find a step that is short enough, and the proxy must
  /// not stay there.
  double step_share = 0.0;
  /// The last tick moved the proxy against friction: the dynamic coefficient holds.
  bool slipping = false;

  bool holds_the_hand() const noexcept { return phase == Phase::touching; }
};

/// Coulomb's coefficients, >= 0, the dynamic one at most the static one.
struct Friction {
  double at_rest = 0.0;
  double sliding = 0.0;
};

/// Moves a SurfaceProxy over one height field; the solid lies below the surface. Free, the hand's whole way
/// of the tick is judged: pieces that are above the upper bound of the heights below them at once, others by
/// bisection down to a pixel, so that a first contact is found in the tick in which it happens. Sliding, each
/// step is at most a pixel (on slopes below 45 degrees and where it passes over no top, half of the hand's
/// own movement in the tick) and must bring the proxy nearer to the hand, so it climbs or rounds a wall and
/// never passes through it. A tick evaluates the surface once or twice as a rule; the more pixels the hand
/// moved the more often, and kMaxEvaluations times at most, so that no tick is long.
template <models::BoundedHeightField Surface>
class ProxyFollower {
 public:
  ProxyFollower(const Surface& surface, Friction friction) noexcept
      : surface_(surface), friction_(friction) {}

  /// One tick: the hand is at `hand`, finite.
  void follow(Point<SceneFrame> hand, SurfaceProxy& proxy) const noexcept {
    const Vec3 hand_m = hand.v;
    if (proxy.phase == SurfaceProxy::Phase::fresh) begin(hand_m, proxy);
    const double moved_m = norm(hand_m - proxy.hand_m);
    const double longest_m = std::max(surface_.pixel_m(), 0.5 * moved_m);
    proxy.hand_m = hand_m;
    int evaluations = kEvaluations + static_cast<int>(std::min(kPerPixel * moved_m / surface_.pixel_m(),
                                                               1.0 * kMaxEvaluations));
    // A slide may leave the surface and the free way meet it again, as from wall to wall of a narrow valley.
    bool met = false;
    for (;;) {
      if (proxy.phase == SurfaceProxy::Phase::free) {
        met = fly(hand_m, proxy, evaluations);
        if (!met) break;
      }
      if (longest_m > surface_.pixel_m() ? slide<Steps::longer>(hand_m, longest_m, proxy, evaluations)
                                         : slide<Steps::pixels>(hand_m, longest_m, proxy, evaluations))
        return;
      // The way on from here is blocked as often as it is tried: the proxy stays touching.
      if (met && evaluations <= 0) return;
      proxy.phase = SurfaceProxy::Phase::free;
      proxy.clearance_m = 0.0;
    }
    if (proxy.place_m != hand_m) hold(hand_m, proxy);
  }

 private:
  /// A slow hand's steps are never longer than a pixel, and need not be watched: its tick is the shorter.
  enum class Steps : std::uint8_t { pixels, longer };
  /// Of a resting hand; for each pixel that it moved; and at most (a jump of many pixels).
  static constexpr int kEvaluations = 3;
  static constexpr double kPerPixel = 1.5;
  static constexpr int kMaxEvaluations = 96;
  /// To find a first contact within a pixel.
  static constexpr int kMeetings = 6;
  /// Bounds are much cheaper than evaluations.
  static constexpr int kPiecesPerEvaluation = 8;
  /// In steps: so far ahead that the memory's answer is there when the place is evaluated.
  static constexpr double kAhead = 3.0;
  /// In longest steps: so far along the surface the proxy of a fast hand slides in a tick, so that it does
  /// not climb over a wall in one.
  static constexpr double kSlides = 3.0;
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

  /// The way to the hand is longer than a tick's evaluations. If the hand is under the surface, the proxy
  /// goes straight down onto it from where it got to, which passes through nothing.
  void hold(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
    if (hand_m.z >= surface_.curved_sample(hand_m.x, hand_m.y).z_m) return;
    rest(proxy, proxy.place_m.x, proxy.place_m.y, surface_.curved_sample(proxy.place_m.x, proxy.place_m.y));
  }

  static void rest(SurfaceProxy& proxy, double x_m, double y_m, const models::CurvedSample& s) noexcept {
    proxy.place_m = {x_m, y_m, s.z_m};
    proxy.surface = s;
    proxy.phase = SurfaceProxy::Phase::touching;
  }

  /// Straight to the hand. True if the surface is in the way: then the proxy rests where it was met first.
  /// Otherwise it is at the hand, or, after a jump, as far on the way as `evaluations` reach.
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
    const double shortest = surface_.pixel_m() / std::max(across, 1e-12);
    double clear = 0.0;
    double piece = 1.0;
    // Enough for the whole way: each evaluation goes on by a pixel at least, and between two of them the
    // pieces are halved a few times.
    const double pixels = std::min(across / surface_.pixel_m(), 1.0 * kMaxEvaluations);
    int left = std::max(evaluations, kEvaluations + static_cast<int>(pixels));
    for (int pieces = kPiecesPerEvaluation * left; clear < 1.0 && left > 0 && pieces > 0; --pieces) {
      const double next = std::min(1.0, clear + piece);
      const Vec3 a = from + clear * way;
      const Vec3 b = from + next * way;
      const double above_all = std::min(a.z, b.z) - surface_.highest_over_m(a.x, a.y, b.x, b.y);
      if (above_all > 0.0) {
        proxy.clearance_m = above_all;
        clear = next;
        piece *= 2.0;
        continue;
      }
      if (piece > shortest) {
        piece = std::max(0.5 * piece, shortest);
        continue;
      }
      --left;
      --evaluations;
      surface_.prefetch(b.x + kAhead * (b.x - a.x), b.y + kAhead * (b.y - a.y));
      const models::CurvedSample s = surface_.curved_sample(b.x, b.y);
      if (b.z < s.z_m) {
        meet(a, b, s.z_m - b.z, clear == 0.0, proxy);
        evaluations -= 2;
        return true;
      }
      proxy.clearance_m = b.z - s.z_m;
      clear = next;
    }
    proxy.place_m = clear >= 1.0 ? hand_m : from + clear * way;
    return false;
  }

  /// The surface is met between a, above it, and b, `depth_m` below it, a pixel apart at most.
  void meet(Vec3 a, Vec3 b, double depth_m, bool from_the_start, SurfaceProxy& proxy) const noexcept {
    // A way that begins on the surface rises from it at first: there the rise takes the place of the
    // clearance, or the proxy would meet the surface again where it is, for ever.
    const Vec3 way = b - a;
    const bool from_contact = from_the_start && proxy.clearance_m <= 0.0;
    double clear_m = from_contact
                         ? std::max(0.0, way.z - proxy.surface.dzdx * way.x - proxy.surface.dzdy * way.y)
                         : std::max(0.0, a.z - surface_.curved_sample(a.x, a.y).z_m);
    // By the false position (Illinois method).
    for (int k = 0; k < kMeetings; ++k) {
      const Vec3 m = a + (clear_m / (clear_m + depth_m)) * (b - a);
      const models::CurvedSample s = surface_.curved_sample(m.x, m.y);
      rest(proxy, m.x, m.y, s);
      const double above_m = m.z - s.z_m;
      if (std::abs(above_m) <= kTolerance_m) break;
      if (above_m > 0.0) {
        a = m;
        clear_m = above_m;
        depth_m *= 0.5;
      } else {
        b = m;
        depth_m = -above_m;
        clear_m *= 0.5;
      }
    }
    proxy.slipping = false;
  }

  /// Along the surface towards the hand; false if the hand is on the free side of the surface where it
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
    double left_m = kSlides * longest_m;
    for (;;) {
      const Vec3 d = hand_m - place;
      const double lifted = d.z - (s.dzdx * d.x + s.dzdy * d.y);
      leaves = lifted > 0.0;
      if (leaves || evaluations <= 0) break;
      if (kSteps == Steps::longer && left_m <= 0.0) break;
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
      if constexpr (kSteps == Steps::longer)
        left_m -= std::sqrt(dx * dx + dy * dy + (next.z_m - place.z) * (next.z_m - place.z));
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
