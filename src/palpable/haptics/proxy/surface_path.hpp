// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/relief/height_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace palpable::haptics {

/// A straight path over or through a height field, judged exactly: in each cell that it passes, its height
/// above the surface is a polynomial (models::PathHeights). Nothing is sampled, so nothing is missed between
/// two places. Tick path.
template <models::BoundedHeightField Surface>
class SurfacePath {
 public:
  /// Cuts that are nowhere deeper may be missed. Where a path begins on the surface next to a cell's border,
  /// rounding alone puts it below.
  static constexpr float kIgnored_m = 1e-6F;
  /// Most cells and blocks of a path that are looked at in one tick, about 10 us: 25 mm over pixels of 0.05
  /// mm, diagonally and nowhere above the blocks around it.
  static constexpr int kMostCells = 1000;

  /// How far a path was followed. Where no entry is found, it is clear to `clear_to` and at least `above_m`
  /// above the surface there.
  struct Followed {
    models::PathEntry entry;
    double clear_to = 0.0;
    double above_m = 0.0;
  };

  SurfacePath(const Surface& surface, Vec3 from, Vec3 to) noexcept
      : surface_(surface),
        from_(from),
        way_(to - from),
        to_(to),
        across_m_(std::sqrt(way_.x * way_.x + way_.y * way_.y)) {
    const double most_m = kStretch * surface.pixel_m();
    if (across_m_ > most_m) stretch_ = most_m / across_m_;
  }

  Vec3 at(double share) const noexcept { return share < 1.0 ? from_ + share * way_ : to_; }
  Vec3 way() const noexcept { return way_; }
  Vec3 to() const noexcept { return to_; }
  /// A bound of what its height above the surface loses over the whole path, where slopes are at most
  /// `steepest`.
  double shrinks_m(double steepest) const noexcept { return across_m_ * steepest + std::max(0.0, -way_.z); }
  double shrinks_m() const noexcept { return shrinks_m(surface_.steepest_slope()); }

  /// What is known of a path's ends: their cells need no bounds, which would show nothing.
  struct Ends {
    bool begins_at_surface = false;
    bool ends_below = false;
  };

  /// Follows the path from the share `from`, where it is above the surface, until it enters it. `shrinks_m`:
  /// a bound of what its height above the surface loses over the whole path. `cells` is reduced by the cells
  /// and blocks that are looked at; without any left the path is followed no farther.
  Followed follow(double from, double shrinks_m, int& cells, Ends ends = {}) const noexcept {
    Followed followed{{}, from, 0.0};
    double stretch = stretch_;
    while (followed.clear_to < 1.0 && cells > 0) {
      const models::PathPart part{followed.clear_to, std::min(1.0, followed.clear_to + stretch)};
      if (stretch_ < 1.0) {
        const bool is_above = is_above_all(part, followed, cells);
        if (is_above && cells > kFew) stretch *= 2.0;
        if (is_above) continue;
        if (cells > kFew && 0.5 * stretch > kShortest * stretch_) {
          stretch *= 0.5;
          continue;
        }
      }
      walk<Side::above>(
          part, {ends.begins_at_surface && part.from <= 0.0, ends.ends_below && part.to >= 1.0}, cells,
          [&](double above_m, double share) {
            followed.clear_to = share;
            followed.above_m = above_m;
            const double spare_m = above_m - shrinks_m * (1.0 - share);
            if (spare_m <= 0.0) return false;
            followed.clear_to = 1.0;
            followed.above_m = spare_m;
            return true;
          },
          followed.entry);
      if (followed.entry.is_found) break;
    }
    return followed;
  }

  /// The share from which the path, below the surface at the share `from`, is above it; 1 if it is nowhere,
  /// or `cells` do not suffice.
  double leaves_at(double from, int& cells) const noexcept {
    models::PathEntry exit;
    walk<Side::below>(
        {from, 1.0}, {}, cells, [](double, double) { return false; }, exit);
    return exit.is_found ? exit.part.to : 1.0;
  }

 private:
  /// Pixels of path whose blocks of bounds are looked at together at first in a path that is longer; twice as
  /// many wherever it is above them, half as many elsewhere, down to this share: then its cells.
  static constexpr double kStretch = 16.0;
  static constexpr double kShortest = 0.2;
  /// With no more cells left, a stretch is not divided: that would leave none for the cells.
  static constexpr int kFew = 100;

  bool is_above_all(const models::PathPart& part, Followed& followed, int& cells) const noexcept {
    --cells;
    const Vec3 a = at(part.from);
    const Vec3 b = at(part.to);
    const double above_m =
        std::min(a.z, b.z) - static_cast<double>(surface_.bounds_over(a.x, a.y, b.x, b.y).highest);
    if (above_m <= 0.0) return false;
    followed.clear_to = part.to;
    followed.above_m = above_m;
    return true;
  }

  enum class Side : std::uint8_t { above, below };

  /// Goes through the cells of a part, in which the path is on one side of the surface, until it enters the
  /// other one, or `done` returns true: it is called at the end of each cell, with a lower bound of the
  /// path's height above the surface there (of `above`). Most cells need only the bounds.
  template <Side kSide, class Done>
  void walk(const models::PathPart& part, Ends ends, int& cells, Done done,
            models::PathEntry& entry) const noexcept {
    const Vec3 a = at(part.from);
    const Vec3 way = at(part.to) - a;
    const double length = part.to - part.from;
    models::CellWalk steps = surface_.cell_walk(a, a + way);
    for (double begin = 0.0; begin < 1.0 && cells > 0; --cells) {
      const double end = steps.next();
      const models::CellPath path = surface_.path_in_cell(a + begin * way, a + end * way);
      const bool needs_heights = (ends.begins_at_surface && begin <= 0.0) || (ends.ends_below && end >= 1.0);
      const models::PathBounds bounds = needs_heights ? models::PathBounds{-1.0F, 1.0F, 0.0F} : path.bounds();
      double above_m = double{bounds.last};
      if (kSide == Side::above ? bounds.lowest < 0.0F : bounds.highest >= 0.0F) {
        const models::PathHeights heights = path.heights();
        entry = kSide == Side::above ? heights.entry(kIgnored_m) : heights.times(-1.0F).entry(kIgnored_m);
        if (entry.is_found) {
          const double scale = length * (end - begin);
          const double first = part.from + length * begin;
          entry.part = {first + scale * entry.part.from, first + scale * entry.part.to};
          return;
        }
        above_m = double{heights.last()};
      }
      begin = end;
      if (done(above_m, end < 1.0 ? part.from + length * end : part.to)) return;
    }
  }

  const Surface& surface_;
  Vec3 from_;
  Vec3 way_;
  Vec3 to_;
  double across_m_;
  double stretch_ = 1.0;
};

/// The least and the greatest of a few values.
template <class T, std::size_t kCount>
std::array<double, 2> extremes(const std::array<T, kCount>& values) noexcept {
  T least = values[0];
  T most = values[0];
  for (const T value : values) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return {double{least}, double{most}};
}

/// Whether a step on the surface from `place` by dx, dy keeps approaching the hand, up to its end or up to
/// the nearest place on its way: then no crest lies between that would hold a proxy back. The derivative of
/// the squared distance along the step is a polynomial of degree 11 in each cell; if its Bernstein
/// coefficients show a place from which the distance may fall after it grew, the answer is no. Tick path.
template <models::BoundedHeightField Surface>
[[gnu::noinline]] bool keeps_approaching(const Surface& surface, Vec3 place, double dx, double dy,
                                         Vec3 hand_m) noexcept {
  using models::PathHeights;
  // The share of a coefficient that rounding may make.
  constexpr double kRounding = 1e-5;
  /// As a share of the step.
  constexpr double kShortest = 1e-6;
  constexpr std::size_t kDegree = 2 * PathHeights::kCount - 3;
  constexpr std::array<double, PathHeights::kCount> kSixth{1, 6, 15, 20, 15, 6, 1};
  constexpr std::array<double, PathHeights::kCount - 1> kFifth{1, 5, 10, 10, 5, 1};
  constexpr std::array<double, kDegree + 1> kEleventh{1, 11, 55, 165, 330, 462, 462, 330, 165, 55, 11, 1};
  const Vec3 a{place.x, place.y, hand_m.z};
  const Vec3 way{dx, dy, 0.0};
  models::CellWalk steps = surface.cell_walk(a, a + way);
  bool has_grown = false;
  for (double begin = 0.0; begin < 1.0;) {
    const double end = steps.next();
    const Vec3 from = a + begin * way;
    const Vec3 piece = (end - begin) * way;
    // A piece so short shows nothing but rounding.
    if (end - begin < kShortest) {
      begin = end;
      continue;
    }
    // The hand's height above the surface below the piece.
    const auto above = surface.path_in_cell(from, from + piece).heights().coefficients();
    const double nears = dot(hand_m - from, piece);
    const double bends = squared_norm(piece) / kDegree;
    std::array<double, PathHeights::kCount - 1> rises;
    for (std::size_t j = 0; j < rises.size(); ++j) rises[j] = 6.0 * (double{above[j + 1]} - double{above[j]});
    begin = end;
    // Mostly, the extremes of both factors show that the distance falls throughout. No jumps here and below:
    // the processor foresees none of them.
    const auto [least, most_above] = extremes(above);
    const auto [falls, climbs] = extremes(rises);
    const double grows_most =
        std::max(std::max(least * falls, least * climbs), std::max(most_above * falls, most_above * climbs));
    if (!has_grown && grows_most - nears + kDegree * bends <= 0.0) continue;
    std::array<double, kDegree + 1> grows{};
    // Unrolled, so that the sums stay in registers.
#pragma GCC unroll 8
    for (std::size_t j = 0; j < rises.size(); ++j)
#pragma GCC unroll 8
      for (std::size_t i = 0; i < PathHeights::kCount; ++i)
        grows[i + j] += kSixth[i] * double{above[i]} * (kFifth[j] * rises[j]);
    double most = 0.0;
    for (std::size_t k = 0; k <= kDegree; ++k) {
      grows[k] = grows[k] * (1.0 / kEleventh[k]) - nears + bends * static_cast<double>(k);
      most = std::max(most, std::abs(grows[k]));
    }
    bool falls_again = false;
    for (const double rate : grows) {
      falls_again |= has_grown & (rate < -kRounding * most);
      has_grown |= rate > kRounding * most;
    }
    if (falls_again) return false;
  }
  return true;
}

}  // namespace palpable::haptics
