// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/proxy/proxy_place.hpp"
#include "palpable/haptics/proxy/surface_path.hpp"
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
/// there. Otherwise each cell below it is judged (SurfacePath): no contact deeper than 1 um is missed,
/// however fast the hand is, and no clear path meets anything. Tick path.
template <models::BoundedHeightField Surface>
class SurfaceFlight {
 public:
  /// Most evaluations of a tick.
  static constexpr int kMaxEvaluations = 96;

  /// Flights with `whole_way` reach their end if it is within SurfacePath::kMostCells. Those with `short_way`
  /// end below the surface.
  enum class Reach : std::uint8_t { whole_way, short_way };

  SurfaceFlight(const Surface& surface, SurfaceProxy& proxy, Vec3 to) noexcept
      : surface_(surface), proxy_(proxy), path_(surface, proxy.place_m, to) {}

  /// Moves the proxy, which is not below the surface, and subtracts from `evaluations`.
  Flown fly(Reach reach, int& evaluations) noexcept {
    // Along the path, the height above the surface decreases by no more than the steepest slope allows.
    double shrinks_m = path_.shrinks_m();
    if (proxy_.clearance_m > shrinks_m) return arrive(proxy_.clearance_m - shrinks_m);
    // A short way ends below the surface, so bounds would show nothing.
    if (reach == Reach::whole_way) {
      const Vec3 from = proxy_.place_m;
      const Vec3 to = path_.to();
      const models::SurfaceBounds bounds = surface_.bounds_over(from.x, from.y, to.x, to.y);
      const double above_all_m = std::min(from.z, to.z) - static_cast<double>(bounds.highest);
      if (above_all_m > 0.0) return arrive(above_all_m);
      shrinks_m = path_.shrinks_m(static_cast<double>(bounds.steepest));
      if (proxy_.clearance_m > shrinks_m) return arrive(proxy_.clearance_m - shrinks_m);
    }

    const int most = reach == Reach::whole_way ? SurfacePath<Surface>::kMostCells : std::max(evaluations, 1);
    int cells = most;
    const auto followed =
        path_.follow(0.0, shrinks_m, cells, {proxy_.clearance_m <= 0.0, reach == Reach::short_way});
    evaluations -= 1 + (most - cells) / kCellsOfAnEvaluation;
    entry_ = followed.entry;
    if (entry_.is_found) return meet(entry_, evaluations);
    if (followed.clear_to < 1.0) return stop(followed.clear_to);
    if (followed.above_m > kRounding_m) return arrive(followed.above_m);
    return end_at_the_surface(evaluations);
  }

  /// After a contact: the part of the path in which it is.
  const models::PathEntry& entry() const noexcept { return entry_; }

 private:
  /// Cells that take as long as one evaluation.
  static constexpr int kCellsOfAnEvaluation = 2;
  /// Iterations to locate a first contact within a part of a cell.
  static constexpr int kMeetings = 12;
  /// Accuracy of a first contact.
  static constexpr double kMet_m = 1e-6;
  /// More than the rounding error of a height above the surface.
  static constexpr double kRounding_m = 1e-7;

  /// In free air nothing is left of an earlier contact.
  Flown arrive(double clearance_m) noexcept {
    proxy_.clearance_m = clearance_m;
    proxy_.step_share = 0.0;
    proxy_.place_m = path_.to();
    return Flown::arrived;
  }

  Flown stop(double share) noexcept {
    proxy_.place_m = path_.at(share);
    proxy_.surface = surface_.paired_sample(models::level_of(proxy_.place_m));
    proxy_.clearance_m = std::max(0.0, proxy_.place_m.z - proxy_.surface.z_m);
    return Flown::stopped;
  }

  /// The path is clear, and its end is on the surface but for rounding.
  Flown end_at_the_surface(int& evaluations) noexcept {
    const Vec3 to = path_.to();
    const models::PairedSample s = surface_.paired_sample(models::level_of(to));
    --evaluations;
    if (to.z >= s.z_m) return arrive(to.z - s.z_m);
    proxy_.rest(to.x, to.y, s);
    proxy_.slipping = false;
    entry_.part = {1.0, 1.0};
    return Flown::met;
  }

  /// Puts the proxy at the contact.
  Flown meet(const models::PathEntry& entry, int& evaluations) noexcept {
    evaluations -= 2;
    // A path that begins on the surface rises from it first: there the rise replaces the height. Otherwise
    // the proxy would meet the surface at the same point again and again.
    double above = entry.part.from;
    double below = entry.part.to;
    const bool leaves_surface = above <= 0.0 && proxy_.clearance_m <= 0.0;
    const double clear_m =
        std::max(0.0, leaves_surface ? rate_over(proxy_.surface) * (below - above) : entry.above_m);
    double share = above + clear_m / std::max(clear_m - entry.below_m, kMet_m) * (below - above);
    // Newton's method, in the interval.
    for (int k = 0; k < kMeetings; ++k) {
      const Vec3 m = path_.at(share);
      const models::PairedSample s = surface_.paired_sample(models::level_of(m));
      proxy_.rest(m.x, m.y, s);
      const double above_m = m.z - s.z_m;
      if (std::abs(above_m) <= kMet_m) break;
      (above_m > 0.0 ? above : below) = share;
      const double newton = share - above_m / rate_over(s);
      share = newton > above && newton < below ? newton : 0.5 * (above + below);
    }
    proxy_.slipping = false;
    return Flown::met;
  }

  double rate_over(const models::PairedSample& s) const noexcept {
    const Vec3 way = path_.way();
    return way.z - s.slope[0] * way.x - s.slope[1] * way.y;
  }

  const Surface& surface_;
  SurfaceProxy& proxy_;
  SurfacePath<Surface> path_;
  models::PathEntry entry_;
};

}  // namespace palpable::haptics
