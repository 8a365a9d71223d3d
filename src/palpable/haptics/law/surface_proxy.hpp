// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/haptics/law/hand_over.hpp"
#include "palpable/models/relief/height_bounds.hpp"
#include "palpable/models/relief/nearest_step.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::haptics {

/// The proxy of a touch on a height field: a point that follows the hand but stays on or above the surface.
/// In free air it is at the hand. In contact it is the surface point nearest to the hand that it can reach by
/// sliding (god-object, Zilles & Salisbury 1995; Ruspini 1997), held back by a friction cone. All zero = a
/// new touch.
struct SurfaceProxy {
  enum class Phase : std::uint8_t {
    fresh,
    /// Above the surface, at the hand (or, after a jump too long for one tick, on its way there).
    free,
    touching
  };

  Vec3 place_m;
  /// The hand's position in the previous tick.
  Vec3 hand_m;
  /// The surface at place_m; valid only while touching.
  models::CurvedSample surface;
  /// A lower bound of the height of place_m above the surface; valid only while free.
  double clearance_m = 0.0;
  Phase phase = Phase::fresh;
  /// The share of the longest step that last brought the proxy nearer; 0 = all of it. It is kept between
  /// ticks, since at a sharp kink one tick may not have enough evaluations to find a step that is short
  /// enough.
  double step_share = 0.0;
  /// The previous tick moved the proxy against friction: the dynamic coefficient applies.
  bool slipping = false;

  bool holds_the_hand() const noexcept { return phase == Phase::touching; }
};

/// Coulomb friction coefficients, >= 0; the dynamic one is at most the static one.
struct Friction {
  double at_rest = 0.0;
  double sliding = 0.0;
};

/// Moves a SurfaceProxy over one height field; the solid is below the surface.
/// In free air, the hand's whole path of the tick is checked. It is clear at once if it is above all heights
/// below it, or higher than the steepest slope can rise there. Otherwise the surface is evaluated along it,
/// at steps that the height above the surface allows, at least a pixel long. So a first contact is found in
/// the tick in which it happens.
/// In contact, each step is at most a pixel long (on slopes below 45 degrees, where it passes over no top:
/// half of the hand's movement in the tick). It must bring the proxy nearer to the hand, so the proxy climbs
/// over a wall or goes around it, and never passes through it.
/// A tick usually evaluates the surface once or twice; more if the hand moved many pixels, about 100 times at
/// most.
template <models::BoundedHeightField Surface>
class ProxyFollower {
 public:
  ProxyFollower(const Surface& surface, Friction friction) noexcept
      : surface_(surface), friction_(friction) {}

  /// Moves the proxy by one tick; `hand` is the hand's position, finite.
  void follow(Point<SceneFrame> hand, SurfaceProxy& proxy) const noexcept {
    const Vec3 hand_m = hand.v;
    if (proxy.phase == SurfaceProxy::Phase::fresh) begin(hand_m, proxy);
    const double moved_m = norm(hand_m - proxy.hand_m);
    const double longest_m = std::max(surface_.pixel_m(), 0.5 * moved_m);
    proxy.hand_m = hand_m;
    int evaluations = kEvaluations + static_cast<int>(std::min(kPerPixel * moved_m / surface_.pixel_m(),
                                                               1.0 * kMaxEvaluations));
    const SurfaceProxy before = proxy;
    // A slide may leave the surface, and the free path may meet it again, as between the walls of a narrow
    // valley.
    bool met = false;
    Reach reach = Reach::whole_way;
    for (;;) {
      if (proxy.phase == SurfaceProxy::Phase::free) {
        met = fly(hand_m, reach, proxy, evaluations);
        if (!met) break;
      }
      const Vec3 from = proxy.place_m;
      const Slid slid = longest_m > surface_.pixel_m()
                            ? slide<Steps::longer>(hand_m, longest_m, proxy, evaluations)
                            : slide<Steps::pixels>(hand_m, longest_m, proxy, evaluations);
      // If every attempt to continue is blocked, the proxy stays in contact.
      if (slid == Slid::rests || (met && evaluations <= 0)) return;
      const bool moved = proxy.place_m != from;
      const bool is_under = hand_m.z < surface_.curved_sample(hand_m.x, hand_m.y).z_m;
      if (is_under && (moved || slid == Slid::unfinished)) return;
      if (passes_over({from.z, proxy.place_m.z, hand_m.z}, most_over_m(longest_m))) return;
      // Only a hand in free air must be reached in this tick.
      reach = is_under ? Reach::short_way : Reach::whole_way;
      const SurfaceProxy there = proxy;
      proxy.phase = SurfaceProxy::Phase::free;
      proxy.clearance_m = 0.0;
      if (!moved) continue;
      // It moves on to another surface point only in the next tick. Otherwise it would climb over a wall and
      // come down behind it in one tick.
      if (!fly(hand_m, reach, proxy, evaluations)) break;
      proxy = there;
      return;
    }
    if (proxy.place_m != hand_m) hold(hand_m, before, longest_m, proxy);
  }

  /// Takes over the proxy of another surface: it moves straight down, or, if it is below this surface, to the
  /// nearest point outside. At most about 200 evaluations. Tick path.
  void take_over(const HandOver& from, SurfaceProxy& proxy) const noexcept {
    const Vec3 place = uncovered(from.place.v, from.touching ? from.normal.v : Vec3{});
    begin(place, proxy);
    proxy.hand_m = from.hand.v;
    proxy.slipping = from.slipping;
    if (from.touching && !proxy.holds_the_hand())
      rest(proxy, place.x, place.y, surface_.curved_sample(place.x, place.y));
  }

 private:
  enum class Reach : std::uint8_t { whole_way, short_way };
  /// How a slide ended: at its final position; with the hand on the free side of the surface; or without
  /// evaluations left.
  enum class Slid : std::uint8_t { rests, leaves, unfinished };
  /// Steps of a slow hand are never longer than a pixel and need no check for walls, which makes its tick
  /// faster.
  enum class Steps : std::uint8_t { pixels, longer };
  /// Surface evaluations per tick: for a resting hand, additional ones per pixel of movement, and the maximum
  /// (after a jump of many pixels).
  static constexpr int kEvaluations = 3;
  static constexpr double kPerPixel = 0.75;
  static constexpr int kMaxEvaluations = 96;
  /// Longest segment for which bounds are used, pixels: bounds over longer ones are too coarse.
  static constexpr double kStretch = 16.0;
  /// Iterations to locate a first contact within a pixel.
  static constexpr int kMeetings = 6;
  /// Accuracy of a first contact.
  static constexpr double kMet_m = 1e-6;
  /// Prefetch distance in steps: far enough that the data are in the cache when that point is evaluated.
  static constexpr double kAhead = 3.0;
  /// Longest slide of a fast hand's proxy in a tick, in longest steps, so that it does not climb over a wall
  /// in one tick.
  static constexpr double kSlides = 3.0;
  /// 1 + slope^2 above which a step is at most a pixel: half-way up a wall a longer one might pass over its
  /// top.
  static constexpr double kSteep2 = 2.0;
  /// At this distance from its final position the proxy rests: 0.05 mN at 500 N/m.
  static constexpr double kTolerance_m = 1e-7;

  /// Heights along a path: at its start, its maximum, and at its end.
  struct Climb {
    double from_m;
    double top_m;
    double to_m;
  };
  /// A path that rises and falls by more than this in one tick leads over a wall: the proxy waits on top of
  /// it for a tick.
  static bool passes_over(Climb climb, double most_m) noexcept {
    return climb.top_m - std::max(climb.from_m, climb.to_m) > most_m;
  }

  double most_over_m(double longest_m) const noexcept {
    return std::max(surface_.pixel_m(), 0.5 * longest_m);
  }

  /// Finds the nearest point on or above the surface for a `place` that is more than a pixel below it: by
  /// sliding towards it from straight above, or along `normal` (0: unknown). The point straight above alone
  /// may be on top of a wall, from which the proxy would come down on the other side.
  Vec3 uncovered(Vec3 place, Vec3 normal) const noexcept {
    const models::CurvedSample above = surface_.curved_sample(place.x, place.y);
    if (above.z_m - place.z <= surface_.pixel_m()) return place;
    SurfaceProxy slid;
    rest(slid, place.x, place.y, above);
    int evaluations = kMaxEvaluations;
    slide<Steps::pixels>(place, surface_.pixel_m(), slid, evaluations);
    const double nearest_m = norm(slid.place_m - place);
    const double step_m = std::max(0.5 * surface_.pixel_m(), nearest_m / kMaxEvaluations);
    for (double way_m = step_m; normal != Vec3{} && way_m < nearest_m; way_m += step_m) {
      const Vec3 p = place + way_m * normal;
      if (p.z >= surface_.curved_sample(p.x, p.y).z_m) return p;
    }
    return slid.place_m;
  }

  /// Starts a new touch at rest; a hand below the surface gets the proxy straight above it.
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

  /// Called if the path to the hand needs more evaluations than a tick has. If the hand is below the surface,
  /// or was in contact and is not yet known to be free, the proxy moves straight down onto the surface from
  /// its present position, so it passes through nothing. A proxy in contact moves no farther than the top of
  /// the first wall on its path.
  void hold(Vec3 hand_m, const SurfaceProxy& before, double longest_m, SurfaceProxy& proxy) const noexcept {
    Vec3 at = proxy.place_m;
    models::CurvedSample s = surface_.curved_sample(at.x, at.y);
    if (!before.holds_the_hand()) {
      if (hand_m.z >= surface_.curved_sample(hand_m.x, hand_m.y).z_m) return;
      return rest(proxy, at.x, at.y, s);
    }
    const Vec3 from = before.place_m;
    const Vec3 way = at - from;
    const double pixels = std::hypot(way.x, way.y) / surface_.pixel_m();
    const int places = 1 + static_cast<int>(std::min(pixels, 1.0 * kMaxEvaluations));
    Vec3 top = from;
    models::CurvedSample at_top = before.surface;
    for (int k = 1; k <= places; ++k) {
      const Vec3 p = from + (1.0 * k / places) * way;
      s = surface_.curved_sample(p.x, p.y);
      if (passes_over({from.z, top.z, s.z_m}, most_over_m(longest_m)))
        return rest(proxy, top.x, top.y, at_top);
      if (s.z_m <= top.z) continue;
      top = {p.x, p.y, s.z_m};
      at_top = s;
    }
    rest(proxy, at.x, at.y, s);
  }

  static void rest(SurfaceProxy& proxy, double x_m, double y_m, const models::CurvedSample& s) noexcept {
    proxy.place_m = {x_m, y_m, s.z_m};
    proxy.surface = s;
    proxy.phase = SurfaceProxy::Phase::touching;
  }

  /// Moves the proxy straight to the hand. True if it meets the surface: then it stays at the first contact.
  /// Otherwise it is at the hand, or as far along the path as the evaluations allow.
  bool fly(Vec3 hand_m, Reach reach, SurfaceProxy& proxy, int& evaluations) const noexcept {
    const Vec3 from = proxy.place_m;
    const Vec3 way = hand_m - from;
    const double across = std::hypot(way.x, way.y);
    const double falls = std::max(0.0, -way.z);
    const auto is_there = [&](double clearance_m) {
      proxy.clearance_m = clearance_m;
      proxy.place_m = hand_m;
      return false;
    };
    // Along the path, the height above the surface decreases by no more than the steepest slope allows.
    double shrinks = across * surface_.steepest_slope() + falls;
    if (proxy.clearance_m > shrinks) return is_there(proxy.clearance_m - shrinks);
    const models::SurfaceBounds bounds = surface_.bounds_over(from.x, from.y, hand_m.x, hand_m.y);
    const double above_all = std::min(from.z, hand_m.z) - static_cast<double>(bounds.highest);
    if (above_all > 0.0) return is_there(above_all);
    shrinks = across * static_cast<double>(bounds.steepest) + falls;
    if (proxy.clearance_m > shrinks) return is_there(proxy.clearance_m - shrinks);
    // Steps that are certainly clear by the clearance, and at least a pixel long, since the surface cannot be
    // hidden within a pixel.
    const double pixels = std::min(across / surface_.pixel_m(), 1.0 * kMaxEvaluations);
    const double shortest = surface_.pixel_m() / std::max(across, 1e-12);
    int left = std::max(evaluations, reach == Reach::whole_way ? 1 + static_cast<int>(pixels) : 1);
    double clear = 0.0;
    for (; clear < 1.0 && left > 0; --left) {
      if (pixels > kStretch) {
        // A long path is checked segment by segment with bounds.
        const double next = std::min(1.0, clear + kStretch * shortest);
        const Vec3 a = from + clear * way;
        const Vec3 b = from + next * way;
        const double above_m =
            std::min(a.z, b.z) - static_cast<double>(surface_.bounds_over(a.x, a.y, b.x, b.y).highest);
        if (above_m > 0.0) {
          proxy.clearance_m = above_m;
          clear = next;
          continue;
        }
      }
      --evaluations;
      const double safe = shrinks > 0.0 ? proxy.clearance_m / shrinks : 0.0;
      // A branch instead of a maximum, so that the processor can speculate on the next segment.
      const double next = std::min(1.0, safe > 2.0 * shortest ? clear + safe : clear + shortest);
      const Vec3 b = from + next * way;
      const double ahead = kAhead * (next - clear);
      surface_.prefetch(b.x + ahead * way.x, b.y + ahead * way.y);
      const models::CurvedSample s = surface_.curved_sample(b.x, b.y);
      if (b.z < s.z_m) {
        meet(from + clear * way, b, s.z_m - b.z, clear == 0.0, proxy);
        evaluations -= 2;
        return true;
      }
      proxy.clearance_m = b.z - s.z_m;
      clear = next;
    }
    proxy.place_m = clear >= 1.0 ? hand_m : from + clear * way;
    return false;
  }

  /// Finds the contact between a, above the surface, and b, `depth_m` below it, at most a pixel apart.
  void meet(Vec3 a, Vec3 b, double depth_m, bool from_the_start, SurfaceProxy& proxy) const noexcept {
    // A path that begins on the surface rises from it first: there the rise replaces the clearance. Otherwise
    // the proxy would meet the surface at the same point again and again.
    const Vec3 way = b - a;
    const bool from_contact = from_the_start && proxy.clearance_m <= 0.0;
    double clear_m = from_contact
                         ? std::max(0.0, way.z - proxy.surface.dzdx * way.x - proxy.surface.dzdy * way.y)
                         : std::max(0.0, a.z - surface_.curved_sample(a.x, a.y).z_m);
    // Regula falsi (Illinois method).
    for (int k = 0; k < kMeetings; ++k) {
      const Vec3 m = a + (clear_m / (clear_m + depth_m)) * (b - a);
      const models::CurvedSample s = surface_.curved_sample(m.x, m.y);
      rest(proxy, m.x, m.y, s);
      const double above_m = m.z - s.z_m;
      if (std::abs(above_m) <= kMet_m) break;
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

  /// Shortens a step to a pixel if the surface between its ends rises by more than the step's length.
  void shorten_at_walls(Vec3 place, double& dx, double& dy) const noexcept {
    const double length2 = dx * dx + dy * dy;
    if (length2 <= surface_.pixel_m() * surface_.pixel_m()) return;
    const models::SurfaceBounds bounds = surface_.bounds_over(place.x, place.y, place.x + dx, place.y + dy);
    const double length_m = std::sqrt(length2);
    if (static_cast<double>(bounds.highest) <= place.z + length_m) return;
    dx *= surface_.pixel_m() / length_m;
    dy *= surface_.pixel_m() / length_m;
  }

  /// Slides the proxy along the surface towards the hand.
  template <Steps kSteps>
  Slid slide(Vec3 hand_m, double longest_m, SurfaceProxy& proxy, int& evaluations) const noexcept {
    // The dependency chain between steps is kept short, since it determines the time of the tick.
    models::CurvedSample s = proxy.surface;
    Vec3 place = proxy.place_m;
    double mu = proxy.slipping ? friction_.sliding : friction_.at_rest;
    bool moved = false;
    Slid slid = Slid::rests;
    double shorter = proxy.step_share > 0.0 ? proxy.step_share : 1.0;
    double left_m = kSlides * longest_m;
    double top_m = place.z;
    for (;;) {
      const Vec3 d = hand_m - place;
      const double lifted = d.z - (s.dzdx * d.x + s.dzdy * d.y);
      if (lifted > 0.0) {
        slid = Slid::leaves;
        break;
      }
      // Squared components of the distance along the normal and along the surface, both times `steep2`.
      const double whole2 = squared_norm(d);
      const double steep2 = 1.0 + (s.dzdx * s.dzdx + s.dzdy * s.dzdy);
      const double normal2 = lifted * lifted;
      const double along2 = std::max(0.0, whole2 * steep2 - normal2);
      const double held2 = mu * mu * normal2;
      const double near = kTolerance_m * std::sqrt(steep2) - mu * lifted;
      if (along2 <= near * near) break;
      if (evaluations <= 0 || (kSteps == Steps::longer && left_m <= 0.0)) {
        slid = Slid::unfinished;
        break;
      }
      const double reach_m = kSteps == Steps::longer && steep2 > kSteep2 ? surface_.pixel_m() : longest_m;
      auto [dx, dy] =
          models::step_towards_nearest(d, s, shorter * (1.0 - std::sqrt(held2 / along2)), shorter * reach_m);
      if constexpr (kSteps == Steps::longer) shorten_at_walls(place, dx, dy);
      const double x = place.x + dx;
      const double y = place.y + dy;
      --evaluations;
      surface_.prefetch(x + kAhead * dx, y + kAhead * dy);
      const models::CurvedSample next = surface_.curved_sample(x, y);
      // A step of more than a pixel must not pass over a top, which may be a wall.
      const bool over_a_top = kSteps == Steps::longer &&
                              dx * dx + dy * dy > surface_.pixel_m() * surface_.pixel_m() &&
                              s.dzdx * dx + s.dzdy * dy > 0.0 && next.dzdx * dx + next.dzdy * dy < 0.0;
      if (over_a_top || squared_norm(hand_m - Vec3{x, y, next.z_m}) >= whole2) {
        // Too far: the surface is curved. Steps shorter than the tolerance are not tried.
        shorter *= 0.25;
        if (dx * dx + dy * dy < kTolerance_m * kTolerance_m) {
          shorter = 1.0;
          break;
        }
        continue;
      }
      shorter = std::min(1.0, 4.0 * shorter);
      top_m = std::max(top_m, next.z_m);
      if (passes_over({proxy.place_m.z, top_m, next.z_m}, most_over_m(longest_m))) {
        slid = Slid::unfinished;
        break;
      }
      moved = true;
      mu = friction_.sliding;
      if constexpr (kSteps == Steps::longer)
        left_m -= std::sqrt(dx * dx + dy * dy + (next.z_m - place.z) * (next.z_m - place.z));
      place = {x, y, next.z_m};
      s = next;
    }
    if (moved) rest(proxy, place.x, place.y, s);
    proxy.slipping = moved;
    if (slid != Slid::leaves) proxy.step_share = shorter;
    return slid;
  }

  const Surface& surface_;
  Friction friction_;
};

}  // namespace palpable::haptics
