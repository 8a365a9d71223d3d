// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/haptics/proxy/hand_over.hpp"
#include "palpable/haptics/proxy/surface_flight.hpp"
#include "palpable/haptics/proxy/surface_path.hpp"
#include "palpable/haptics/proxy/surface_slide.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::haptics {

/// Moves a SurfaceProxy over one height field; the solid is below the surface.
/// In free air, the hand's whole path of the tick is checked (SurfaceFlight), so a first contact is found in
/// the tick in which it happens.
/// In contact it slides towards the hand (SurfaceSlide). A hand in free air that it sees has it at once.
/// A tick usually evaluates the surface once or twice; more if the hand moved many pixels, about 100 times at
/// most.
template <models::BoundedHeightField Surface>
class ProxyFollower {
 public:
  ProxyFollower(const Surface& surface, Friction friction) noexcept
      : surface_(surface), slide_(surface, friction) {}

  /// Whether the proxy is in contact, and the hand moved by less than a pixel in this tick: mostly.
  bool is_held_slowly(Vec3 hand_m, const SurfaceProxy& proxy) const noexcept {
    return proxy.holds_the_hand() &&
           squared_norm(hand_m - proxy.hand_m) < surface_.pixel_m() * surface_.pixel_m();
  }

  /// Moves a proxy that is_held_slowly() by one tick. True if it came to rest by its first slide, as it
  /// mostly does: then it is in contact, as `end` tells. Inlined, so that what follows finds its place and
  /// surface in registers. `before`: the proxy before the tick.
  [[gnu::always_inline]] bool follow_slowly(Vec3 hand_m, const ProxyBefore& before, SurfaceProxy& proxy,
                                            SlideEnd& end) const noexcept {
    Left left{surface_.pixel_m(), kEvaluations};
    proxy.hand_m = hand_m;
    proxy.crossed_m = 0.0;
    const Slid slid = slide_.slide_by_pixels(hand_m, proxy, left.evaluations, end);
    if (slid == Slid::rests) [[likely]]
      return true;
    follow_on(slid, before, left, proxy);
    return false;
  }

  /// Moves the proxy by one tick; `hand_m` is the hand's position, finite.
  [[gnu::noinline, gnu::flatten]] void follow(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
    if (proxy.phase == SurfaceProxy::Phase::fresh) begin(hand_m, proxy);
    const ProxyBefore before{proxy.place_m, proxy.holds_the_hand(), proxy.hand_m};
    Left left = allowance(norm(hand_m - before.hand_m));
    proxy.hand_m = hand_m;
    proxy.crossed_m = 0.0;
    Slid slid = Slid::leaves;
    if (before.touching) {
      SlideEnd end;
      slid = slide_.slide(hand_m, left.longest_m, proxy, left.evaluations, end);
      if (slid == Slid::rests) return;
    } else if (proxy.clearance_m <= left.longest_m) {
      // The hand may meet the surface in the next tick: where it will probably be.
      surface_.prefetch(hand_m, hand_m + (hand_m - before.hand_m));
    }
    follow_on(slid, before, left, proxy);
  }

  /// Takes over the proxy of another surface: it moves straight down, or, if it is below this surface, to the
  /// nearest point outside. At most about 200 evaluations. Tick path.
  void take_over(const HandOver& from, SurfaceProxy& proxy) const noexcept {
    const Vec3 place = uncovered(from.place.v, from.touching ? from.normal.v : Vec3{});
    begin(place, proxy);
    proxy.hand_m = from.hand.v;
    proxy.slipping = from.slipping;
    if (from.touching && !proxy.holds_the_hand())
      proxy.rest(place.x, place.y, surface_.paired_sample(models::level_of(place)));
  }

 private:
  using Reach = typename SurfaceFlight<Surface>::Reach;
  /// Surface evaluations per tick: for a resting hand, additional ones per pixel of movement, and the maximum
  /// (after a jump of many pixels).
  static constexpr int kEvaluations = 3;
  static constexpr double kPerPixel = 0.75;
  /// What a slide may use at least after the first contact of a flight: for the way to a hand within a pixel
  /// of it, which is one step, and for others, whose steps are half the hand's movement.
  static constexpr int kAfterMeetingNear = 1;
  static constexpr int kAfterMeeting = 2;
  static constexpr int kMaxEvaluations = SurfaceFlight<Surface>::kMaxEvaluations;
  /// Steps of a slide to a hand in the air, about 30 us: 20 mm over pixels of 0.05 mm; and how many crests it
  /// may pass.
  static constexpr int kToHand = 400;
  static constexpr int kCrests = 40;
  /// A contact within this distance of a place is at this place.
  static constexpr double kReturned_m = 1e-5;
  /// What is left of a tick after its first slide: the longest step, and evaluations.
  struct Left {
    double longest_m;
    int evaluations;
  };
  /// What the parts of a tick share.
  struct Tick {
    Vec3 hand_m;
    Vec3 hand_before_m;
    /// The proxy before the tick, and where it last left the surface in it.
    Vec3 place_before_m;
    Vec3 left_m;
    double longest_m;
    int evaluations;
    bool was_held;
    bool met = false;
    /// The straight way from the proxy to the hand was followed, and is not clear.
    bool is_blocked = false;
    /// Where the flight along the hand's path met it first, if it did.
    models::PathEntry entry{};
  };

  /// What a tick may use after a hand's movement.
  Left allowance(double moved_m) const noexcept {
    const double pixel_m = surface_.pixel_m();
    return {std::max(pixel_m, 0.5 * moved_m),
            kEvaluations + static_cast<int>(std::min(kPerPixel * moved_m / pixel_m, 1.0 * kMaxEvaluations))};
  }

  /// The rest of a tick whose proxy was free, or whose first slide ended with `slid` before it came to rest.
  [[gnu::noinline]] void follow_on(Slid slid, const ProxyBefore& before, Left left,
                                   SurfaceProxy& proxy) const noexcept {
    Tick tick{proxy.hand_m,   before.hand_m,    before.place_m, before.place_m,
              left.longest_m, left.evaluations, before.touching};
    if (!reaches_hand_after(slid, tick.place_before_m, proxy, tick)) {
      if (!slide_.is_known_below(tick.hand_m, proxy) && lets_go(proxy, tick)) {
        proxy.lift_off();
        proxy.place_m = tick.hand_m;
      }
      return;
    }
    // The proxy is free, at the hand. Did the hand cut the surface on its way? If it was under the surface,
    // after it left that.
    if (tick.was_held || tick.met) note_crossing(proxy, tick);
  }

  /// Moves the proxy towards the hand, as far as the surface lets it; true if it is free and at the hand
  /// then.
  [[gnu::noinline, gnu::flatten]] bool reaches_hand(SurfaceProxy& proxy, Tick& tick) const noexcept {
    const Vec3 from = proxy.place_m;
    SlideEnd end;
    const Slid slid = slide_.slide(tick.hand_m, tick.longest_m, proxy, tick.evaluations, end);
    return slid != Slid::rests && reaches_hand_after(slid, from, proxy, tick);
  }

  /// The same after a slide of a proxy in contact, from `from`; of a free one from its place on.
  [[gnu::noinline, gnu::flatten]] bool reaches_hand_after(Slid slid, Vec3 from, SurfaceProxy& proxy,
                                                          Tick& tick) const noexcept {
    const Vec3 hand_m = tick.hand_m;
    // A slide may leave the surface, and the free path may meet it again, as between the walls of a narrow
    // valley.
    bool met = false;
    Reach reach = Reach::whole_way;
    Vec3 flown_from = proxy.place_m;
    for (;;) {
      if (!proxy.holds_the_hand()) {
        flown_from = proxy.place_m;
        SurfaceFlight<Surface> flight(surface_, proxy, hand_m);
        met = flight.fly(reach, tick.evaluations) == Flown::met;
        if (!met) break;
        if (!tick.met) {
          tick.entry = flight.entry();
          // In a pit the flight may be far shorter than a pixel. If it left nothing for the slide, the proxy
          // would stay there, however far the hand went.
          const bool is_near =
              squared_norm(hand_m - proxy.place_m) <= surface_.pixel_m() * surface_.pixel_m();
          tick.evaluations = std::max(tick.evaluations, is_near ? kAfterMeetingNear : kAfterMeeting);
        }
        tick.met = true;
        from = proxy.place_m;
        SlideEnd end;
        slid = slide_.slide(hand_m, tick.longest_m, proxy, tick.evaluations, end);
        if (slid == Slid::rests) return false;
      }
      // If every attempt to continue is blocked, the proxy stays in contact.
      if (met && tick.evaluations <= 0) return false;
      const bool moved = proxy.place_m != from;
      const bool is_under = slide_.is_known_below(hand_m, proxy) || slide_.is_hand_below(hand_m, proxy);
      if (is_under && (moved || slid == Slid::unfinished)) return false;
      if (slide_.passes_over({from.z, proxy.place_m.z, hand_m.z}, tick.longest_m)) return false;
      // Only a hand in free air must be reached in this tick.
      reach = is_under ? Reach::short_way : Reach::whole_way;
      tick.left_m = proxy.place_m;
      if (!moved) {
        proxy.lift_off();
        continue;
      }
      // It moves on to another surface point only in the next tick. Otherwise it would climb over a wall and
      // come down behind it in one tick.
      const SurfaceProxy there = proxy;
      proxy.lift_off();
      flown_from = proxy.place_m;
      if (fly(hand_m, reach, proxy, tick.evaluations) != Flown::met) break;
      proxy = there;
      tick.is_blocked = true;
      return false;
    }
    if (proxy.place_m == hand_m) return true;
    hold(proxy, flown_from, tick);
    return false;
  }

  /// Whether the hand is in the air, its path of this tick was, and nothing holds it back from the proxy in
  /// contact, where that is or where it was before the tick: it may have slid behind a bump meanwhile.
  [[gnu::noinline]] bool lets_go(const SurfaceProxy& proxy, const Tick& tick) const noexcept {
    // Mostly, one look at where the hand is or was shows that it was not in the air.
    return !is_below(tick.hand_m) && !slide_.is_known_below(tick.hand_before_m, proxy) &&
           !is_below(tick.hand_before_m) && is_clear(tick.hand_before_m, tick.hand_m) &&
           ((!tick.is_blocked && is_clear(proxy.place_m, tick.hand_m)) ||
            is_clear(tick.place_before_m, tick.hand_m) || is_over(proxy, tick.hand_m) ||
            slides_to_hand(proxy, tick.hand_m));
  }

  /// Whether no ground between a proxy and a hand above it rises above the hand: straight up from the proxy
  /// nothing is in the way either.
  bool is_over(const SurfaceProxy& proxy, Vec3 hand_m) const noexcept {
    return hand_m.z >= proxy.place_m.z && is_clear({proxy.place_m.x, proxy.place_m.y, hand_m.z}, hand_m);
  }

  /// Whether a proxy without friction slides, without climbing over a wall, to where it sees a hand in the
  /// air: then no wall is between both, only the edge over which the hand slipped. A proxy never rests below
  /// its hand, so one whose hand is higher also slides over and around what is in its way, as it would in the
  /// next ticks.
  bool slides_to_hand(const SurfaceProxy& proxy, Vec3 hand_m) const noexcept {
    SurfaceProxy slid = proxy;
    int evaluations = kToHand;
    if (hand_m.z > proxy.place_m.z) return climbs_to_hand(slid, hand_m, evaluations);
    // Steps by pixels could pass over a wall that rises above both.
    const double top_m = proxy.place_m.z + kBump_pixels * surface_.pixel_m();
    if (!is_clear({proxy.place_m.x, proxy.place_m.y, top_m}, {hand_m.x, hand_m.y, top_m})) return false;
    SlideEnd end;
    SurfaceSlide<Surface>(surface_, {}).slide_by_pixels(hand_m, slid, evaluations, end);
    return is_clear(slid.place_m, hand_m);
  }

  bool climbs_to_hand(SurfaceProxy& slid, Vec3 hand_m, int evaluations) const noexcept {
    const SurfaceSlide<Surface> freely(surface_, {});
    for (int crests = 0; crests < kCrests && evaluations > 0; ++crests) {
      SlideEnd end;
      const Slid how = freely.slide_by_pixels(hand_m, slid, evaluations, end);
      if (how == Slid::rests) break;
      if (how == Slid::unfinished) continue;
      slid.lift_off();
      if (fly(hand_m, Reach::whole_way, slid, evaluations) != Flown::met) return slid.place_m == hand_m;
    }
    return is_clear(slid.place_m, hand_m);
  }

  /// For a proxy that is free, at a hand in the air whose path in this tick may have cut the surface: the
  /// contact of the cut. A proxy that was in contact goes back to where the hand entered, and may be held.
  [[gnu::noinline]] void note_crossing(SurfaceProxy& proxy, Tick& tick) const noexcept {
    const SurfacePath<Surface> path(surface_, tick.hand_before_m, tick.hand_m);
    int cells = 2 * SurfacePath<Surface>::kMostCells;
    if (tick.was_held) {
      const double out = is_below(tick.hand_before_m) ? path.leaves_at(0.0, cells) : 0.0;
      tick.entry = path.follow(out, path.shrinks_m(), cells).entry;
      if (!tick.entry.is_found) return;
    }
    const models::PathPart cut{tick.entry.part.from, path.leaves_at(tick.entry.part.to, cells)};
    Vec3 at_m = path.at(cut.from);
    if (tick.was_held) {
      // A hand that comes back through a wall to its proxy was held until then, where the proxy is.
      const Vec3 left_m = tick.left_m;
      if (!returns_to(at_m, proxy, tick)) at_m = left_m;
      if (!reaches_hand(proxy, tick)) return;
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
    proxy.place_m = tick.left_m;
    proxy.lift_off();
    if (fly(entry_m, Reach::whole_way, proxy, tick.evaluations) == Flown::met)
      return norm(proxy.place_m - entry_m) < kReturned_m;
    const Vec3 at = proxy.place_m;
    proxy.rest(at.x, at.y, surface_.paired_sample(models::level_of(at)));
    return true;
  }

  /// Finds the nearest point on or above the surface for a `place` that is more than a pixel below it: by
  /// sliding towards it from straight above, or along `normal` (0: unknown). The point straight above alone
  /// may be on top of a wall, from which the proxy would come down on the other side.
  Vec3 uncovered(Vec3 place, Vec3 normal) const noexcept {
    const models::PairedSample above = surface_.paired_sample(models::level_of(place));
    if (above.z_m - place.z <= surface_.pixel_m()) return place;
    SurfaceProxy slid;
    slid.rest(place.x, place.y, above);
    int evaluations = kMaxEvaluations;
    SlideEnd end;
    slide_.slide(place, surface_.pixel_m(), slid, evaluations, end);
    const double nearest_m = norm(slid.place_m - place);
    const double step_m = std::max(0.5 * surface_.pixel_m(), nearest_m / kMaxEvaluations);
    for (double way_m = step_m; normal != Vec3{} && way_m < nearest_m; way_m += step_m) {
      const Vec3 p = place + way_m * normal;
      if (p.z >= surface_.paired_sample(models::level_of(p)).z_m) return p;
    }
    return slid.place_m;
  }

  /// Starts a new touch at rest; a hand below the surface gets the proxy straight above it.
  [[gnu::noinline]] void begin(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
    const models::PairedSample s = surface_.paired_sample(models::level_of(hand_m));
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

  /// What rises less above a proxy, in pixels, is no wall.
  static constexpr double kBump_pixels = 0.1;

  bool is_below(Vec3 p) const noexcept { return p.z < surface_.sample(p.x, p.y).z_m; }

  /// Whether a straight path that begins outside and ends in the air cuts nothing.
  bool is_clear(Vec3 from, Vec3 to) const noexcept {
    // Mostly it cuts something near its start, or half-way, which takes less time to see.
    if (is_below(from + 0.1 * (to - from)) || is_below(from + 0.5 * (to - from))) return false;
    const SurfacePath<Surface> path(surface_, from, to);
    int cells = SurfacePath<Surface>::kMostCells;
    const auto followed = path.follow(0.0, path.shrinks_m(), cells);
    return !followed.entry.is_found && followed.clear_to >= 1.0 && !is_below(to);
  }

  Flown fly(Vec3 to_m, Reach reach, SurfaceProxy& proxy, int& evaluations) const noexcept {
    return SurfaceFlight<Surface>(surface_, proxy, to_m).fly(reach, evaluations);
  }

  /// Called if a flight stopped on its way to the hand, since a tick has no more evaluations. If the hand is
  /// below the surface, or was in contact and is not yet known to be free, the proxy moves straight down onto
  /// the surface from its present position, so it passes through nothing. A proxy in contact moves no farther
  /// than the top of the first wall on its path.
  void hold(SurfaceProxy& proxy, Vec3 flown_from, const Tick& tick) const noexcept {
    if (!tick.was_held && !is_below(tick.hand_m)) return;
    const Vec3 at = proxy.place_m;
    const models::PairedSample end = proxy.surface;
    proxy.rest(at.x, at.y, end);
    // No wall rises above a flight that descends from where the proxy was.
    const Vec3 from = tick.place_before_m;
    if (!tick.was_held || (flown_from == from && at.z <= from.z)) return;
    const Vec3 way = at - from;
    const double pixels = std::hypot(way.x, way.y) / surface_.pixel_m();
    const int places = 1 + static_cast<int>(std::min(pixels, 1.0 * kMaxEvaluations));
    Vec3 top = from;
    models::PairedSample at_top = surface_.paired_sample(models::level_of(from));
    for (int k = 1; k <= places; ++k) {
      const Vec3 p = from + (1.0 * k / places) * way;
      const models::PairedSample s = k < places ? surface_.paired_sample(models::level_of(p)) : end;
      if (slide_.passes_over({from.z, top.z, s.z_m}, tick.longest_m)) return proxy.rest(top.x, top.y, at_top);
      if (s.z_m <= top.z) continue;
      top = {p.x, p.y, s.z_m};
      at_top = s;
    }
  }

  const Surface& surface_;
  SurfaceSlide<Surface> slide_;
};

}  // namespace palpable::haptics
