// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/haptics/proxy/hand_over.hpp"
#include "palpable/haptics/proxy/surface_flight.hpp"
#include "palpable/haptics/proxy/surface_path.hpp"
#include "palpable/models/relief/nearest_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace palpable::haptics {

/// Coulomb friction coefficients, >= 0; the dynamic one is at most the static one.
struct Friction {
  double at_rest = 0.0;
  double sliding = 0.0;
};

/// Moves a SurfaceProxy over one height field; the solid is below the surface.
/// In free air, the hand's whole path of the tick is checked (SurfaceFlight), so a first contact is found in
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
    if (proxy.phase == SurfaceProxy::Phase::fresh) begin(hand.v, proxy);
    const SurfaceProxy before = proxy;
    const double moved_m = norm(hand.v - proxy.hand_m);
    proxy.hand_m = hand.v;
    proxy.crossed_m = 0.0;
    Tick tick;
    tick.hand_m = hand.v;
    tick.longest_m = std::max(surface_.pixel_m(), 0.5 * moved_m);
    tick.evaluations = kEvaluations + static_cast<int>(std::min(kPerPixel * moved_m / surface_.pixel_m(),
                                                                1.0 * kMaxEvaluations));
    if (!reaches_hand(before, proxy, tick)) return;
    // The proxy is free, at the hand. Did the hand cut the surface on its way? If it was under the surface,
    // after it left that.
    if (!before.holds_the_hand() && !tick.met) return;
    note_crossing(before, proxy, tick);
  }

  /// Takes over the proxy of another surface: it moves straight down, or, if it is below this surface, to the
  /// nearest point outside. At most about 200 evaluations. Tick path.
  void take_over(const HandOver& from, SurfaceProxy& proxy) const noexcept {
    const Vec3 place = uncovered(from.place.v, from.touching ? from.normal.v : Vec3{});
    begin(place, proxy);
    proxy.hand_m = from.hand.v;
    proxy.slipping = from.slipping;
    if (from.touching && !proxy.holds_the_hand())
      proxy.rest(place.x, place.y, surface_.curved_sample(place.x, place.y));
  }

 private:
  using Reach = typename SurfaceFlight<Surface>::Reach;
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
  static constexpr int kMaxEvaluations = SurfaceFlight<Surface>::kMaxEvaluations;
  /// Longest slide of a fast hand's proxy in a tick, in longest steps, so that it does not climb over a wall
  /// in one tick.
  static constexpr double kSlides = 3.0;
  /// 1 + slope^2 above which a step is at most a pixel: half-way up a wall a longer one might pass over its
  /// top.
  static constexpr double kSteep2 = 2.0;
  /// A contact within this distance of a place is at this place.
  static constexpr double kReturned_m = 1e-5;
  /// The difference from a parabola, as a share of what the distance loses, from which a step is examined.
  static constexpr double kUneven = 0.5;
  /// Steps shorter than this share of a pixel are not checked for crests.
  static constexpr double kSure_px = 0.01;
  /// At this distance from its final position the proxy rests: 0.05 mN at 500 N/m.
  static constexpr double kTolerance_m = 1e-7;

  /// What the parts of a tick share.
  struct Tick {
    Vec3 hand_m;
    double longest_m = 0.0;
    int evaluations = 0;
    bool met = false;
    /// Where the flight along the hand's path met it first, if it did.
    models::PathEntry entry;
    /// The proxy when it last left the surface.
    std::optional<SurfaceProxy> left;
  };

  /// Moves the proxy towards the hand, as far as the surface lets it; true if it is free and at the hand
  /// then.
  bool reaches_hand(const SurfaceProxy& before, SurfaceProxy& proxy, Tick& tick) const noexcept {
    const Vec3 hand_m = tick.hand_m;
    const double longest_m = tick.longest_m;
    // A slide may leave the surface, and the free path may meet it again, as between the walls of a narrow
    // valley.
    bool met = false;
    Reach reach = Reach::whole_way;
    Vec3 flown_from = proxy.place_m;
    for (;;) {
      if (proxy.phase == SurfaceProxy::Phase::free) {
        flown_from = proxy.place_m;
        SurfaceFlight<Surface> flight(surface_, proxy, hand_m);
        met = flight.fly(reach, tick.evaluations) == Flown::met;
        if (!met) break;
        if (!tick.met) tick.entry = flight.entry();
        tick.met = true;
      }
      const Vec3 from = proxy.place_m;
      const Slid slid = longest_m > surface_.pixel_m()
                            ? slide<Steps::longer>(hand_m, longest_m, proxy, tick.evaluations)
                            : slide<Steps::pixels>(hand_m, longest_m, proxy, tick.evaluations);
      // If every attempt to continue is blocked, the proxy stays in contact.
      if (slid == Slid::rests || (met && tick.evaluations <= 0)) return false;
      const bool moved = proxy.place_m != from;
      const bool is_under = is_below(hand_m);
      if (is_under && (moved || slid == Slid::unfinished)) return false;
      if (passes_over({from.z, proxy.place_m.z, hand_m.z}, most_over_m(longest_m))) return false;
      // Only a hand in free air must be reached in this tick.
      reach = is_under ? Reach::short_way : Reach::whole_way;
      tick.left = proxy;
      proxy.phase = SurfaceProxy::Phase::free;
      proxy.clearance_m = 0.0;
      if (!moved) continue;
      // It moves on to another surface point only in the next tick. Otherwise it would climb over a wall and
      // come down behind it in one tick.
      flown_from = proxy.place_m;
      if (fly(hand_m, reach, proxy, tick.evaluations) != Flown::met) break;
      proxy = *tick.left;
      return false;
    }
    if (proxy.place_m == hand_m) return true;
    hold(hand_m, before, flown_from, longest_m, proxy);
    return false;
  }

  /// For a proxy that is free, at a hand in the air whose path in this tick may have cut the surface: the
  /// contact of the cut. A proxy that was in contact goes back to where the hand entered, and may be held.
  [[gnu::noinline]] void note_crossing(const SurfaceProxy& before, SurfaceProxy& proxy,
                                       Tick& tick) const noexcept {
    const SurfacePath<Surface> path(surface_, before.hand_m, tick.hand_m);
    int cells = 2 * SurfacePath<Surface>::kMostCells;
    if (before.holds_the_hand()) {
      const double out = is_below(before.hand_m) ? path.leaves_at(0.0, cells) : 0.0;
      const Vec3 way = path.way();
      const double shrinks_m = std::hypot(way.x, way.y) * surface_.steepest_slope() + std::max(0.0, -way.z);
      tick.entry = path.follow(out, shrinks_m, cells).entry;
      if (!tick.entry.is_found) return;
    }
    const models::PathPart cut{tick.entry.part.from, path.leaves_at(tick.entry.part.to, cells)};
    Vec3 at_m = path.at(cut.from);
    if (before.holds_the_hand()) {
      // A hand that comes back through a wall to its proxy was held until then, where the proxy is.
      const Vec3 left_m = tick.left->place_m;
      if (!returns_to(at_m, proxy, tick)) at_m = left_m;
      if (!reaches_hand(before, proxy, tick)) return;
    }
    at_m.z = std::max(at_m.z, surface_.sample(at_m.x, at_m.y).z_m);
    proxy.crossed_at_m = at_m;
    proxy.crossed_m = std::min(depth_of(path, cut, -tick.entry.below_m), norm(at_m - tick.hand_m));
  }

  /// How deep a path is in a part of it that is below the surface: at least `deepest_m`, and at three places.
  /// No place of a chord is farther from the air than half its length.
  double depth_of(const SurfacePath<Surface>& path, const models::PathPart& cut,
                  double deepest_m) const noexcept {
    const double length = cut.to - cut.from;
    for (const double share : {0.25, 0.5, 0.75}) {
      const Vec3 p = path.at(cut.from + share * length);
      deepest_m = std::max(deepest_m, surface_.sample(p.x, p.y).z_m - p.z);
    }
    return std::min(deepest_m, 0.5 * length * norm(path.way()));
  }

  /// Leads the proxy from where it left the surface in this tick to the place where the hand cut it again;
  /// false if it meets the surface before.
  [[gnu::noinline]] bool returns_to(Vec3 entry_m, SurfaceProxy& proxy, Tick& tick) const noexcept {
    proxy = *tick.left;
    proxy.phase = SurfaceProxy::Phase::free;
    proxy.clearance_m = 0.0;
    if (fly(entry_m, Reach::whole_way, proxy, tick.evaluations) == Flown::met)
      return norm(proxy.place_m - entry_m) < kReturned_m;
    const Vec3 at = proxy.place_m;
    proxy.rest(at.x, at.y, surface_.curved_sample(at.x, at.y));
    return true;
  }

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
    slid.rest(place.x, place.y, above);
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
      proxy.rest(hand_m.x, hand_m.y, s);
    } else {
      proxy.place_m = hand_m;
      proxy.surface = s;
      proxy.clearance_m = hand_m.z - s.z_m;
      proxy.phase = SurfaceProxy::Phase::free;
    }
  }

  bool is_below(Vec3 p) const noexcept { return p.z < surface_.sample(p.x, p.y).z_m; }

  Flown fly(Vec3 to_m, Reach reach, SurfaceProxy& proxy, int& evaluations) const noexcept {
    return SurfaceFlight<Surface>(surface_, proxy, to_m).fly(reach, evaluations);
  }

  /// Called if a flight stopped on its way to the hand, since a tick has no more evaluations. If the hand is
  /// below the surface, or was in contact and is not yet known to be free, the proxy moves straight down onto
  /// the surface from its present position, so it passes through nothing. A proxy in contact moves no farther
  /// than the top of the first wall on its path.
  void hold(Vec3 hand_m, const SurfaceProxy& before, Vec3 flown_from, double longest_m,
            SurfaceProxy& proxy) const noexcept {
    if (!before.holds_the_hand() && !is_below(hand_m)) return;
    const Vec3 at = proxy.place_m;
    const models::CurvedSample end = proxy.surface;
    proxy.rest(at.x, at.y, end);
    // No wall rises above a flight that descends from where the proxy was.
    const Vec3 from = before.place_m;
    if (!before.holds_the_hand() || (flown_from == from && at.z <= from.z)) return;
    const Vec3 way = at - from;
    const double pixels = std::hypot(way.x, way.y) / surface_.pixel_m();
    const int places = 1 + static_cast<int>(std::min(pixels, 1.0 * kMaxEvaluations));
    Vec3 top = from;
    models::CurvedSample at_top = before.surface;
    for (int k = 1; k <= places; ++k) {
      const Vec3 p = from + (1.0 * k / places) * way;
      const models::CurvedSample s = k < places ? surface_.curved_sample(p.x, p.y) : end;
      if (passes_over({from.z, top.z, s.z_m}, most_over_m(longest_m)))
        return proxy.rest(top.x, top.y, at_top);
      if (s.z_m <= top.z) continue;
      top = {p.x, p.y, s.z_m};
      at_top = s;
    }
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

  /// Whether a step passes over a crest that would hold a proxy back: then the squared distance to the hand
  /// falls, grows and falls again. It is examined only where the distances and their changes at the two ends
  /// are not nearly those of a parabola, whose changes sum to twice the difference.
  bool passes_crest(Vec3 place, const models::CurvedSample& s, Vec3 next, const models::CurvedSample& there,
                    Vec3 hand_m) const noexcept {
    const Vec3 step = next - place;
    const Vec3 d = hand_m - place;
    const Vec3 e = hand_m - next;
    const double falls = squared_norm(d) - squared_norm(e);
    const double at_start = step.x * (d.x + d.z * s.dzdx) + step.y * (d.y + d.z * s.dzdy);
    const double at_end = step.x * (e.x + e.z * there.dzdx) + step.y * (e.y + e.z * there.dzdy);
    const double least2 = kSure_px * kSure_px * surface_.pixel_m() * surface_.pixel_m();
    return std::abs(at_start + at_end - falls) > kUneven * falls &&
           step.x * step.x + step.y * step.y > least2 &&
           !keeps_approaching(surface_, place, step.x, step.y, hand_m);
  }

  /// Whether the hand is in free air beside the crest on which the proxy is (offset `d`, sample `s`):
  /// friction must not hold it there. Evaluates the surface only where its curvature at the proxy suggests
  /// that.
  bool is_beside_crest(Vec3 d, const models::CurvedSample& s, double steep2, Vec3 hand_m) const noexcept {
    if (steep2 > kSteep2) return false;
    const double bent = s.dzdx * d.x + s.dzdy * d.y +
                        0.5 * (s.dzdxx_per_m * d.x * d.x + s.dzdyy_per_m * d.y * d.y) +
                        s.dzdxy_per_m * d.x * d.y;
    return bent < d.z && !is_below(hand_m);
  }

  /// Slides the proxy along the surface towards the hand.
  template <Steps kSteps>
  Slid slide(Vec3 hand_m, double longest_m, SurfaceProxy& proxy, int& evaluations) const noexcept {
    // The dependency chain between steps is kept short, since it determines the time of the tick.
    models::CurvedSample s = proxy.surface;
    Vec3 place = proxy.place_m;
    double sliding = friction_.sliding;
    double mu = proxy.slipping ? sliding : friction_.at_rest;
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
      if (along2 <= near * near) {
        if (mu <= 0.0 || !is_beside_crest(d, s, steep2, hand_m)) break;
        mu = sliding = 0.0;
        continue;
      }
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
      surface_.prefetch(x + SurfaceFlight<Surface>::kAhead * dx, y + SurfaceFlight<Surface>::kAhead * dy);
      const models::CurvedSample next = surface_.curved_sample(x, y);
      // A step of more than a pixel must not pass over a top, which may be a wall.
      const bool over_a_top = kSteps == Steps::longer &&
                              dx * dx + dy * dy > surface_.pixel_m() * surface_.pixel_m() &&
                              s.dzdx * dx + s.dzdy * dy > 0.0 && next.dzdx * dx + next.dzdy * dy < 0.0;
      if (over_a_top || squared_norm(hand_m - Vec3{x, y, next.z_m}) >= whole2 ||
          passes_crest(place, s, {x, y, next.z_m}, next, hand_m)) {
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
      mu = sliding;
      if constexpr (kSteps == Steps::longer)
        left_m -= std::sqrt(dx * dx + dy * dy + (next.z_m - place.z) * (next.z_m - place.z));
      place = {x, y, next.z_m};
      s = next;
    }
    if (moved) proxy.rest(place.x, place.y, s);
    proxy.slipping = moved;
    if (slid != Slid::leaves) proxy.step_share = shorter;
    return slid;
  }

  const Surface& surface_;
  Friction friction_;
};

}  // namespace palpable::haptics
