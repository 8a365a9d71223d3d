// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/proxy/proxy_place.hpp"
#include "palpable/models/relief/height_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::haptics {

/// How a straight flight of a proxy ended: at its end; at the first contact; or, without evaluations left, on
/// the way. Then proxy.surface is the surface below proxy.place_m.
enum class Flown : std::uint8_t { arrived, met, stopped };

/// Moves a SurfaceProxy straight through free air, up to the first contact with a height field.
/// The path is clear at once if it is above all heights below it, or higher than the steepest slope can rise
/// there. Otherwise the surface is evaluated along it, at steps that the height above the surface allows, and
/// at least a pixel long. A crest between two evaluations is found where the height above the surface first
/// falls and then rises: at its minimum, in up to three evaluations. Tick path.
template <models::BoundedHeightField Surface>
class SurfaceFlight {
 public:
  /// Most evaluations of a flight in one tick.
  static constexpr int kMaxEvaluations = 96;
  /// Prefetch distance in steps: far enough that the data are in the cache when that point is evaluated.
  static constexpr double kAhead = 3.0;

  /// Flights with `whole_way` have at least the evaluations that reach their end. Those with `short_way` end
  /// below the surface.
  enum class Reach : std::uint8_t { whole_way, short_way };

  /// A crest between two evaluations that the path cuts by at most `over_m` is no contact: a proxy slides
  /// over such a crest within a tick.
  SurfaceFlight(const Surface& surface, SurfaceProxy& proxy, Vec3 to, double over_m) noexcept
      : surface_(surface),
        proxy_(proxy),
        from_(proxy.place_m),
        way_(to - proxy.place_m),
        to_(to),
        over_m_(over_m) {}

  /// Moves the proxy, which is not below the surface, and subtracts from `evaluations`.
  Flown fly(Reach reach, int& evaluations) noexcept {
    const double across = std::hypot(way_.x, way_.y);
    const double falls = std::max(0.0, -way_.z);
    // Along the path, the height above the surface decreases by no more than the steepest slope allows.
    double shrinks = across * surface_.steepest_slope() + falls;
    if (proxy_.clearance_m > shrinks) return arrive(proxy_.clearance_m - shrinks);
    // A short way ends below the surface, so bounds would show nothing.
    const bool may_be_clear = reach == Reach::whole_way;
    if (may_be_clear) {
      const models::SurfaceBounds bounds = surface_.bounds_over(from_.x, from_.y, to_.x, to_.y);
      const double above_all = std::min(from_.z, to_.z) - static_cast<double>(bounds.highest);
      if (above_all > 0.0) return arrive(above_all);
      shrinks = across * static_cast<double>(bounds.steepest) + falls;
      if (proxy_.clearance_m > shrinks) return arrive(proxy_.clearance_m - shrinks);
    }

    const double pixels = std::min(across / surface_.pixel_m(), 1.0 * kMaxEvaluations);
    const double shortest = surface_.pixel_m() / std::max(across, 1e-12);
    int left = std::max(evaluations, may_be_clear ? 1 + static_cast<int>(pixels) : 1);
    Gap gap;
    if (proxy_.clearance_m <= 0.0) gap = {0.0, 0.0, std::max(0.0, rate_over(proxy_.surface)), true};
    bool sampled = false;
    for (; gap.share < 1.0 && left > 0; --left) {
      if (may_be_clear && pixels > kStretch &&
          is_clear(gap, std::min(1.0, gap.share + kStretch * shortest))) {
        sampled = false;
        continue;
      }
      --evaluations;
      const double safe = shrinks > 0.0 ? proxy_.clearance_m / shrinks : 0.0;
      // A branch instead of a maximum, so that the processor can speculate on the next segment.
      const double next = std::min(1.0, safe > 2.0 * shortest ? gap.share + safe : gap.share + shortest);
      const Gap there = gap_at(next, kAhead * (next - gap.share));
      sampled = true;
      if (there.above_m < 0.0) {
        evaluations -= 2;
        return meet(gap, there);
      }
      // A step below the safe one is clear as it is.
      if (there.rate_m > 0.0 && next - gap.share > safe) {
        const Flown dip = fly_through(gap, there, evaluations);
        if (dip == Flown::met) return dip;
      }
      proxy_.clearance_m = there.above_m;
      gap = there;
    }
    if (gap.share >= 1.0) return arrive(proxy_.clearance_m);
    if (!sampled) gap = gap_at(gap.share, 0.0);
    proxy_.place_m = at(gap.share);
    return Flown::stopped;
  }

 private:
  /// Longest segment for which bounds are used, pixels: bounds over longer ones are too coarse.
  static constexpr double kStretch = 16.0;
  /// Iterations to locate a first contact within a step, and the lowest point over a crest.
  static constexpr int kMeetings = 6;
  static constexpr int kDips = 3;
  /// Accuracy of a first contact.
  static constexpr double kMet_m = 1e-6;

  /// A place on the path, as a share of it: its height above the surface, and how much this grows per whole
  /// path.
  struct Gap {
    double share = 0.0;
    double above_m = 0.0;
    double rate_m = 0.0;
    bool is_known = false;
  };

  Vec3 at(double share) const noexcept { return share < 1.0 ? from_ + share * way_ : to_; }

  double rate_over(const models::CurvedSample& s) const noexcept {
    return way_.z - s.dzdx * way_.x - s.dzdy * way_.y;
  }

  Gap gap_at(double share, double ahead) noexcept {
    const Vec3 p = from_ + share * way_;
    surface_.prefetch(p.x + ahead * way_.x, p.y + ahead * way_.y);
    proxy_.surface = surface_.curved_sample(p.x, p.y);
    return {share, p.z - proxy_.surface.z_m, rate_over(proxy_.surface), true};
  }

  Flown arrive(double clearance_m) noexcept {
    proxy_.clearance_m = clearance_m;
    proxy_.place_m = to_;
    return Flown::arrived;
  }

  /// Whether a segment of a long path is above all heights below it; then `gap` moves to its end.
  bool is_clear(Gap& gap, double next) noexcept {
    const Vec3 a = at(gap.share);
    const Vec3 b = at(next);
    const double above_m =
        std::min(a.z, b.z) - static_cast<double>(surface_.bounds_over(a.x, a.y, b.x, b.y).highest);
    if (above_m <= 0.0) return false;
    proxy_.clearance_m = above_m;
    gap = {next, above_m, 0.0, false};
    return true;
  }

  /// Checks the path between two places above the surface, from the second of which it rises: if it falls
  /// from the first, a crest between them may touch it.
  Flown fly_through(Gap a, Gap b, int& evaluations) noexcept {
    const models::CurvedSample last = proxy_.surface;
    if (!a.is_known) {
      a = gap_at(a.share, 0.0);
      --evaluations;
    }
    for (int k = 0; k < kDips && a.rate_m < 0.0 && b.rate_m > 0.0; ++k) {
      // The tangents at both ends meet below a crest that is round there.
      const double length = b.share - a.share;
      const double tangents_m = (a.above_m * b.rate_m - b.above_m * a.rate_m + length * a.rate_m * b.rate_m) /
                                (b.rate_m - a.rate_m);
      if (tangents_m > 0.0) break;
      // The minimum of the cubic through both heights and slopes (Nocedal & Wright 2006, eq. 3.59).
      const double d1 = a.rate_m + b.rate_m - 3.0 * (b.above_m - a.above_m) / length;
      const double d2 = std::sqrt(std::max(0.0, d1 * d1 - a.rate_m * b.rate_m));
      const double back = (b.rate_m + d2 - d1) / (b.rate_m - a.rate_m + 2.0 * d2);
      const Gap low = gap_at(b.share - length * std::clamp(back, 0.05, 0.95), 0.0);
      --evaluations;
      if (low.above_m < -over_m_) return meet(a, low);
      if (low.above_m < 0.0) break;
      (low.rate_m < 0.0 ? a : b) = low;
    }
    proxy_.surface = last;
    return Flown::arrived;
  }

  /// Puts the proxy at the contact between `from`, above the surface, and `to`, below it.
  Flown meet(Gap from, Gap to) noexcept {
    // A path that begins on the surface rises from it first: there the rise replaces the height. Otherwise
    // the proxy would meet the surface at the same point again and again.
    Vec3 a = at(from.share);
    Vec3 b = at(to.share);
    double clear_m = from.is_known ? from.above_m : a.z - surface_.curved_sample(a.x, a.y).z_m;
    if (clear_m <= 0.0) clear_m = std::max(0.0, from.rate_m * (to.share - from.share));
    double depth_m = -to.above_m;
    // Regula falsi (Illinois method).
    for (int k = 0; k < kMeetings; ++k) {
      const Vec3 m = a + (clear_m / (clear_m + depth_m)) * (b - a);
      const models::CurvedSample s = surface_.curved_sample(m.x, m.y);
      proxy_.rest(m.x, m.y, s);
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
    proxy_.slipping = false;
    return Flown::met;
  }

  const Surface& surface_;
  SurfaceProxy& proxy_;
  Vec3 from_;
  Vec3 way_;
  Vec3 to_;
  double over_m_;
};

}  // namespace palpable::haptics
