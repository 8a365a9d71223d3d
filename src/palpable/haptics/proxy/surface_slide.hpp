// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/proxy/proxy_place.hpp"
#include "palpable/haptics/proxy/surface_path.hpp"
#include "palpable/models/relief/height_bounds.hpp"
#include "palpable/models/relief/nearest_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::haptics {

/// Coulomb friction coefficients, >= 0; the dynamic one is at most the static one.
struct Friction {
  double at_rest = 0.0;
  double sliding = 0.0;
};

/// How a slide ended: at its final position; with the hand on the free side of the surface; or without
/// evaluations left.
enum class Slid : std::uint8_t { rests, leaves, unfinished };

/// What the end of a slide knows of its place and the hand, for the force there.
struct SlideEnd {
  Vec3 place_m;
  /// From the proxy to the hand.
  models::WayFromSurface way;
  models::Pair slope;
  /// 1 + slope^2; and the way times the upward direction {-slope, 1}.
  double steep2;
  double lifted_m;
};

/// Slides a SurfaceProxy in contact along a height field towards the hand, held back by friction. Each step
/// is at most a pixel long (on slopes below 45 degrees, where it passes over no top: half of the hand's
/// movement in the tick). It must bring the proxy nearer to the hand, so the proxy climbs over a wall or goes
/// around it, and never passes through it. Tick path.
template <models::BoundedHeightField Surface>
class SurfaceSlide {
 public:
  SurfaceSlide(const Surface& surface, Friction friction) noexcept : surface_(surface), friction_(friction) {}

  /// Steps are at most `longest_m` long, at least a pixel. Subtracts from `evaluations`. `end` is set if the
  /// slide rests.
  [[gnu::always_inline]] Slid slide(Vec3 hand_m, double longest_m, SurfaceProxy& proxy, int& evaluations,
                                    SlideEnd& end) const noexcept {
    return longest_m > surface_.pixel_m() ? slide<Steps::longer>(hand_m, longest_m, proxy, evaluations, end)
                                          : slide<Steps::pixels>(hand_m, longest_m, proxy, evaluations, end);
  }

  /// The same, of a hand that moves by less than a pixel.
  [[gnu::always_inline]] Slid slide_by_pixels(Vec3 hand_m, SurfaceProxy& proxy, int& evaluations,
                                              SlideEnd& end) const noexcept {
    return slide<Steps::pixels>(hand_m, surface_.pixel_m(), proxy, evaluations, end);
  }

  /// Whether the hand is known to be below the surface, by an earlier evaluation.
  bool is_known_below(Vec3 hand_m, const SurfaceProxy& proxy) const noexcept {
    const double steepest = surface_.steepest_slope();
    return squared_norm(hand_m - proxy.under_at_m) * (1.0 + steepest * steepest) <
           proxy.under_m * proxy.under_m;
  }

  /// Whether the hand, which is not known to be, is below the surface; the proxy remembers it.
  [[gnu::noinline]] bool is_hand_below(Vec3 hand_m, SurfaceProxy& proxy) const noexcept {
    const double under_m = surface_.sample(hand_m.x, hand_m.y).z_m - hand_m.z;
    if (under_m <= 0.0) return false;
    proxy.under_at_m = hand_m;
    proxy.under_m = under_m;
    return true;
  }

  /// Heights along a path: at its start, its maximum, and at its end.
  struct Climb {
    double from_m;
    double top_m;
    double to_m;
  };
  /// Whether a path leads over a wall: it rises and falls by more than a pixel, or half the longest step, in
  /// one tick. The proxy waits on top of it for a tick.
  bool passes_over(Climb climb, double longest_m) const noexcept {
    return climb.top_m - std::max(climb.from_m, climb.to_m) > std::max(surface_.pixel_m(), 0.5 * longest_m);
  }

 private:
  /// Steps of a slow hand are never longer than a pixel and need no check for walls, which makes its tick
  /// faster.
  enum class Steps : std::uint8_t { pixels, longer };
  /// Longest slide of a fast hand's proxy in a tick, in longest steps, so that it does not climb over a wall
  /// in one tick.
  static constexpr double kSlides = 3.0;
  /// 1 + slope^2 above which a step is at most a pixel: half-way up a wall a longer one might pass over its
  /// top.
  static constexpr double kSteep2 = 2.0;
  /// The difference from a parabola, as a share of what the distance loses, from which a step is examined.
  static constexpr double kUneven = 0.5;
  /// Steps shorter than this share of a pixel are not checked for crests.
  static constexpr double kSure_px = 0.01;
  /// Prefetch distance in steps: far enough that the data are in the cache when that point is evaluated.
  static constexpr double kAhead = 3.0;
  /// At this distance from its final position the proxy rests: 0.05 mN at 500 N/m.
  static constexpr double kTolerance_m = 1e-7;

  using Pair = models::Pair;

  /// Shortens a step to a pixel if the surface between its ends rises by more than the step's length.
  Pair shortened_at_walls(Pair place, double z_m, Pair step) const noexcept {
    const double length2 = models::sum_of(step * step);
    if (length2 <= surface_.pixel_m() * surface_.pixel_m()) return step;
    const Pair end = place + step;
    const models::SurfaceBounds bounds = surface_.bounds_over(place[0], place[1], end[0], end[1]);
    const double length_m = std::sqrt(length2);
    if (static_cast<double>(bounds.highest) <= z_m + length_m) return step;
    return (surface_.pixel_m() / length_m) * step;
  }

  /// Whether a step of more than a pixel rises at its start and falls at its end. No jumps: the processor
  /// foresees none of them, but mostly that not all are true.
  bool rises_and_falls(Pair slope, Pair slope_after, Pair step) const noexcept {
    const bool is_long = models::sum_of(step * step) > surface_.pixel_m() * surface_.pixel_m();
    const bool rises = models::sum_of(slope * step) > 0.0;
    const bool falls = models::sum_of(slope_after * step) < 0.0;
    return (is_long & rises & falls) != 0;
  }

  /// Whether a step passes over a crest that would hold a proxy back: then the squared distance to the hand
  /// falls, grows and falls again. It is examined only where the distances and their changes at the two ends
  /// are not nearly those of a parabola, whose changes sum to twice the difference.
  bool passes_crest(Pair place, double z_m, const models::WayFromSurface& before,
                    const models::WayFromSurface& after, Pair step, Vec3 hand_m) const noexcept {
    const double falls = before.whole2 - after.whole2;
    const double changes = models::sum_of(step * (before.down + after.down));
    const double least2 = kSure_px * kSure_px * surface_.pixel_m() * surface_.pixel_m();
    return std::abs(changes - falls) > kUneven * falls && models::sum_of(step * step) > least2 &&
           !keeps_approaching(surface_, {place[0], place[1], z_m}, step[0], step[1], hand_m);
  }

  /// Whether the distance along the surface is within the tolerance of what friction holds, both times the
  /// root of `steep2`, which is at least 1. Bounds of that root decide mostly, so that a jump that the
  /// processor did not foresee does not wait for it.
  [[gnu::always_inline]] static bool is_near(double along2, double held, double steep2) noexcept {
    const double least = kTolerance_m - held;
    if (along2 <= least * least) return true;
    const double most = kTolerance_m * steep2 - held;
    if (along2 > most * most) [[likely]]
      return false;
    const double near = kTolerance_m * std::sqrt(steep2) - held;
    return along2 <= near * near;
  }

  /// Which part of a step to the nearest point leads to where friction holds: 1 - sqrt(held2 / along2). Near
  /// 1, the root is approximated (Pade, order [2/2]), and the division is left to the caller, since both are
  /// on the tick's critical path. The part is at most 2 % too small.
  [[gnu::always_inline]] static models::StepPart part_outside(double along2, double held2) noexcept {
    if (held2 < 0.25 * along2) return {1.0 - std::sqrt(held2 / along2), 1.0};
    const double product = along2 * held2;
    const double square = along2 * along2;
    const double held4 = held2 * held2;
    return {4.0 * (square - held4), 5.0 * (square + (product + product)) + held4};
  }

  /// Slides the proxy along the surface towards the hand. Inlined with all it calls (its callers are
  /// flattened), since a call of a surface evaluation with its result in memory would cost a third of it.
  template <Steps kSteps>
  [[gnu::always_inline]] Slid slide(Vec3 hand_m, double longest_m, SurfaceProxy& proxy, int& evaluations,
                                    SlideEnd& end) const noexcept {
    // The dependency chain between steps is kept short, since it determines the time of the tick.
    const Pair hand{hand_m.x, hand_m.y};
    models::PairedSample s = proxy.surface;
    s.z_m = proxy.place_m.z;
    Pair place{proxy.place_m.x, proxy.place_m.y};
    double sliding = friction_.sliding;
    double mu = proxy.slipping ? sliding : friction_.at_rest;
    bool moved = false;
    // How a slide ends at its final position: one that found the hand in the air is not at its end.
    Slid in_air = Slid::rests;
    Slid slid = Slid::rests;
    double shorter = proxy.step_share > 0.0 ? proxy.step_share : 1.0;
    double left_m = kSlides * longest_m;
    const double from_m = s.z_m;
    double top_m = s.z_m;
    models::WayFromSurface way = models::way_from_surface(hand - place, hand_m.z - s.z_m, s.slope);
    for (;;) {
      const double lifted = way.rise - models::sum_of(s.slope * way.level);
      if (lifted > 0.0) {
        slid = Slid::leaves;
        break;
      }
      // Squared components of the distance along the normal and along the surface, both times `steep2`.
      const double steep2 = 1.0 + models::sum_of(s.slope * s.slope);
      const double normal2 = lifted * lifted;
      const double along2 = std::max(0.0, way.whole2 * steep2 - normal2);
      const double held2 = mu * mu * normal2;
      if (is_near(along2, mu * lifted, steep2)) {
        end = {{place[0], place[1], s.z_m}, way, s.slope, steep2, lifted};
        slid = in_air;
        if (mu <= 0.0) break;
        if (is_known_below(hand_m, proxy) || is_hand_below(hand_m, proxy)) [[likely]]
          break;
        // Friction does not hold a hand that is in the air.
        mu = sliding = 0.0;
        in_air = Slid::unfinished;
        continue;
      }
      if (evaluations <= 0 || (kSteps == Steps::longer && left_m <= 0.0)) {
        slid = Slid::unfinished;
        break;
      }
      const double reach_m = kSteps == Steps::longer && steep2 > kSteep2 ? surface_.pixel_m() : longest_m;
      models::StepPart part = part_outside(along2, held2);
      part.of *= shorter;
      Pair step = models::step_towards_nearest(way, s, steep2, part, shorter * reach_m);
      if constexpr (kSteps == Steps::longer) step = shortened_at_walls(place, s.z_m, step);
      const Pair stepped = place + step;
      --evaluations;
      // A proxy that does not come to rest in this tick asks about the hand, which may be far from it.
      if (evaluations <= 0) surface_.prefetch(hand_m.x, hand_m.y);
      // The first step shows where the proxy goes, in this tick and the next.
      if (!moved) {
        const Pair ahead = stepped + kAhead * step;
        surface_.prefetch(ahead[0], ahead[1]);
      }
      const models::PairedSample next = surface_.paired_sample(stepped);
      // A step of more than a pixel must not pass over a top, which may be a wall.
      const bool over_a_top = kSteps == Steps::longer && rises_and_falls(s.slope, next.slope, step);
      const models::WayFromSurface after =
          models::way_from_surface(hand - stepped, hand_m.z - next.z_m, next.slope);
      if (over_a_top || after.whole2 >= way.whole2 || passes_crest(place, s.z_m, way, after, step, hand_m)) {
        // Too far: the surface is curved. Steps shorter than the tolerance are not tried.
        shorter *= 0.25;
        if (models::sum_of(step * step) < kTolerance_m * kTolerance_m) {
          end = {{place[0], place[1], s.z_m}, way, s.slope, steep2, lifted};
          shorter = 1.0;
          break;
        }
        continue;
      }
      shorter = std::min(1.0, 4.0 * shorter);
      top_m = std::max(top_m, next.z_m);
      if (passes_over({from_m, top_m, next.z_m}, longest_m)) {
        slid = Slid::unfinished;
        break;
      }
      moved = true;
      mu = sliding;
      if constexpr (kSteps == Steps::longer) {
        const double climbed_m = next.z_m - s.z_m;
        left_m -= std::sqrt(models::sum_of(step * step) + climbed_m * climbed_m);
      }
      place = stepped;
      s = next;
      way = after;
    }
    proxy.rest(place[0], place[1], s);
    proxy.slipping = moved;
    if (slid != Slid::leaves) proxy.step_share = shorter;
    return slid;
  }

  const Surface& surface_;
  Friction friction_;
};

}  // namespace palpable::haptics
