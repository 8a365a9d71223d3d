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

/// Slides a SurfaceProxy in contact along a height field towards the hand, held back by friction. Each step
/// is at most a pixel long (on slopes below 45 degrees, where it passes over no top: half of the hand's
/// movement in the tick). It must bring the proxy nearer to the hand, so the proxy climbs over a wall or goes
/// around it, and never passes through it. Tick path.
template <models::BoundedHeightField Surface>
class SurfaceSlide {
 public:
  SurfaceSlide(const Surface& surface, Friction friction) noexcept : surface_(surface), friction_(friction) {}

  /// Steps are at most `longest_m` long, at least a pixel. Subtracts from `evaluations`.
  [[gnu::always_inline]] Slid slide(Vec3 hand_m, double longest_m, SurfaceProxy& proxy,
                                    int& evaluations) const noexcept {
    return longest_m > surface_.pixel_m() ? slide<Steps::longer>(hand_m, longest_m, proxy, evaluations)
                                          : slide<Steps::pixels>(hand_m, longest_m, proxy, evaluations);
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

  /// Whether a step of more than a pixel rises at its start and falls at its end. No jumps: the processor
  /// foresees none of them, but mostly that not all are true.
  bool rises_and_falls(const models::CurvedSample& from, const models::CurvedSample& to, double dx,
                       double dy) const noexcept {
    const bool is_long = dx * dx + dy * dy > surface_.pixel_m() * surface_.pixel_m();
    const bool rises = from.dzdx * dx + from.dzdy * dy > 0.0;
    const bool falls = to.dzdx * dx + to.dzdy * dy < 0.0;
    return (is_long & rises & falls) != 0;
  }

  /// Whether a step passes over a crest that would hold a proxy back: then the squared distance to the hand
  /// falls, grows and falls again. It is examined only where the distances and their changes at the two ends
  /// are not nearly those of a parabola, whose changes sum to twice the difference.
  bool passes_crest(Vec3 place, const models::WayFromSurface& before, const models::WayFromSurface& after,
                    double dx, double dy, Vec3 hand_m) const noexcept {
    const double falls = before.whole2 - after.whole2;
    const models::Pair step{dx, dy};
    const models::Pair starts = step * models::Pair{before.down_x, before.down_y};
    const models::Pair ends = step * models::Pair{after.down_x, after.down_y};
    const double at_start = starts[0] + starts[1];
    const double at_end = ends[0] + ends[1];
    const double least2 = kSure_px * kSure_px * surface_.pixel_m() * surface_.pixel_m();
    return std::abs(at_start + at_end - falls) > kUneven * falls && dx * dx + dy * dy > least2 &&
           !keeps_approaching(surface_, place, dx, dy, hand_m);
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

  /// Whether the hand is in free air beside the crest on which the proxy is (offset `d`, sample `s`):
  /// friction must not hold it there. Evaluates the surface only where its curvature at the proxy suggests
  /// that.
  bool is_beside_crest(Vec3 d, const models::CurvedSample& s, double steep2, Vec3 hand_m) const noexcept {
    if (steep2 > kSteep2) return false;
    const double bent = s.dzdx * d.x + s.dzdy * d.y +
                        0.5 * (s.dzdxx_per_m * d.x * d.x + s.dzdyy_per_m * d.y * d.y) +
                        s.dzdxy_per_m * d.x * d.y;
    return bent < d.z && hand_m.z >= surface_.sample(hand_m.x, hand_m.y).z_m;
  }

  /// Slides the proxy along the surface towards the hand. Inlined with all it calls (its callers are
  /// flattened), since a call of a surface evaluation with its result in memory would cost a third of it.
  template <Steps kSteps>
  [[gnu::always_inline]] Slid slide(Vec3 hand_m, double longest_m, SurfaceProxy& proxy,
                                    int& evaluations) const noexcept {
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
    models::WayFromSurface way = models::way_from_surface(hand_m - place, s);
    for (;;) {
      const Vec3 d = way.d;
      const models::Pair slope{s.dzdx, s.dzdy};
      const models::Pair along_d = slope * models::Pair{d.x, d.y};
      const double lifted = d.z - (along_d[0] + along_d[1]);
      if (lifted > 0.0) {
        slid = Slid::leaves;
        break;
      }
      // Squared components of the distance along the normal and along the surface, both times `steep2`.
      const models::Pair slope2 = slope * slope;
      const double steep2 = 1.0 + (slope2[0] + slope2[1]);
      const double normal2 = lifted * lifted;
      const double along2 = std::max(0.0, way.whole2 * steep2 - normal2);
      const double held2 = mu * mu * normal2;
      if (is_near(along2, mu * lifted, steep2)) {
        if (mu <= 0.0 || !is_beside_crest(d, s, steep2, hand_m)) break;
        mu = sliding = 0.0;
        continue;
      }
      if (evaluations <= 0 || (kSteps == Steps::longer && left_m <= 0.0)) {
        slid = Slid::unfinished;
        break;
      }
      const double reach_m = kSteps == Steps::longer && steep2 > kSteep2 ? surface_.pixel_m() : longest_m;
      auto [dx, dy] = models::step_towards_nearest(way, s, shorter * (1.0 - std::sqrt(held2 / along2)),
                                                   shorter * reach_m);
      if constexpr (kSteps == Steps::longer) shorten_at_walls(place, dx, dy);
      const double x = place.x + dx;
      const double y = place.y + dy;
      --evaluations;
      // The first step shows where the proxy goes, in this tick and the next.
      if (!moved) surface_.prefetch(x + kAhead * dx, y + kAhead * dy);
      const models::CurvedSample next = surface_.curved_sample(x, y);
      // A step of more than a pixel must not pass over a top, which may be a wall.
      const bool over_a_top = kSteps == Steps::longer && rises_and_falls(s, next, dx, dy);
      const models::WayFromSurface after = models::way_from_surface(hand_m - Vec3{x, y, next.z_m}, next);
      if (over_a_top || after.whole2 >= way.whole2 || passes_crest(place, way, after, dx, dy, hand_m)) {
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
      if (passes_over({proxy.place_m.z, top_m, next.z_m}, longest_m)) {
        slid = Slid::unfinished;
        break;
      }
      moved = true;
      mu = sliding;
      if constexpr (kSteps == Steps::longer)
        left_m -= std::sqrt(dx * dx + dy * dy + (next.z_m - place.z) * (next.z_m - place.z));
      place = {x, y, next.z_m};
      s = next;
      way = after;
    }
    proxy.rest(place.x, place.y, s);
    proxy.slipping = moved;
    if (slid != Slid::leaves) proxy.step_share = shorter;
    return slid;
  }

  const Surface& surface_;
  Friction friction_;
};

}  // namespace palpable::haptics
