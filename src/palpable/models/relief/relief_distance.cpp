// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_distance.hpp"

#include "palpable/models/relief/nearest_step.hpp"
#include "palpable/models/relief/spline_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace palpable::models {
namespace {

/// Newton's method from one starting point, until a step is below 0.1 nm.
Vec3 descend(const Relief& relief, Vec3 p, double x_m, double y_m) {
  constexpr int kMostSteps = 80;
  constexpr double kEnough_m = 1e-10;
  const Pair to{p.x, p.y};
  Pair at{x_m, y_m};
  PairedSample s = relief.paired_sample(at);
  WayFromSurface way = way_from_surface(to - at, p.z - s.z_m, s.slope);
  double shorter = 1.0;
  for (int k = 0; k < kMostSteps; ++k) {
    const Pair step = step_towards_nearest(way, s, 1.0 + sum_of(s.slope * s.slope), {.of = shorter},
                                           shorter * relief.pixel_m());
    if (std::hypot(step[0], step[1]) < kEnough_m) break;
    const PairedSample next = relief.paired_sample(at + step);
    const WayFromSurface after = way_from_surface(to - (at + step), p.z - next.z_m, next.slope);
    if (after.whole2 > way.whole2) {
      shorter *= 0.5;
      continue;
    }
    shorter = std::min(1.0, 2.0 * shorter);
    at += step;
    s = next;
    way = after;
  }
  return {at[0], at[1], s.z_m};
}

/// The search for the nearest point of one relief: by bounds over its cells and their parts, so that no part
/// that may be nearer is left out.
class Search {
 public:
  Search(const Relief& relief, Vec3 p)
      : relief_(relief),
        p_(p),
        middle_x_m_(0.5 * (relief.samples_m().width() - 1) * relief.pixel_m()),
        middle_y_m_(0.5 * (relief.samples_m().height() - 1) * relief.pixel_m()) {
    try_from(p.x, p.y);
    const std::vector<Cell> cells = cells_within(best_m_);
    for (const Cell& cell : cells) {
      if (!may_be_nearer(cell.least_m)) break;
      try_parts(patch_of(cell.column, cell.row), cell.least_m);
    }
  }

  Vec3 best() const { return best_; }

 private:
  struct Cell {
    int column, row;
    /// A lower bound of the distance.
    double least_m;
  };
  /// A point that is not nearer by more than this is not searched for.
  static constexpr double kEnough_m = 1e-9;
  /// Parts of a cell's side: Newton's method is tried from the first on, and the last is not divided.
  static constexpr double kTried = 0.25, kLast = 1.0 / 65536.0;

  bool may_be_nearer(double least_m) const { return least_m < best_m_ - kEnough_m; }

  void try_from(double x_m, double y_m) {
    const Vec3 found = descend(relief_, p_, x_m, y_m);
    const double distance_m = norm(p_ - found);
    if (distance_m >= best_m_) return;
    best_m_ = distance_m;
    best_ = found;
  }

  /// The place in the axes of patches: x to the right and y down from the first sample.
  Vec3 place() const { return {p_.x + middle_x_m_, middle_y_m_ - p_.y, p_.z}; }

  /// The cell between two columns and two rows. The surface continues beyond the border.
  SplinePatch patch_of(int column, int row) const {
    const Raster<float>& z = relief_.samples_m();
    std::array<double, 16> control;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        control[static_cast<std::size_t>(4 * j + i)] =
            z(std::clamp(column - 1 + i, 0, z.width() - 1), std::clamp(row - 1 + j, 0, z.height() - 1));
    return {column * relief_.pixel_m(), row * relief_.pixel_m(), relief_.pixel_m(), control};
  }

  /// The cells that may have a point within a distance, those first that may have the nearest. Two cells
  /// beyond the border the surface is level.
  std::vector<Cell> cells_within(double reach_m) const {
    const double pixel_m = relief_.pixel_m();
    const Vec3 at = place();
    const auto held = [&](double v_m, int samples) {
      return static_cast<int>(std::clamp(std::floor(v_m / pixel_m), -2.0, samples + 0.0));
    };
    const int right = held(at.x + reach_m, relief_.samples_m().width());
    const int bottom = held(at.y + reach_m, relief_.samples_m().height());
    const double above_m = std::max({0.0, p_.z - relief_.highest_m(), relief_.lowest_m() - p_.z});
    const auto beside_m = [&](double v_m, int cell) {
      return std::max({0.0, cell * pixel_m - v_m, v_m - (cell + 1) * pixel_m});
    };
    std::vector<Cell> cells;
    for (int row = held(at.y - reach_m, relief_.samples_m().height()); row <= bottom; ++row)
      for (int column = held(at.x - reach_m, relief_.samples_m().width()); column <= right; ++column) {
        if (!may_be_nearer(norm(Vec3{beside_m(at.x, column), beside_m(at.y, row), above_m}))) continue;
        const double least_m = patch_of(column, row).least_distance_m(at);
        if (may_be_nearer(least_m)) cells.push_back({column, row, least_m});
      }
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.least_m < b.least_m; });
    return cells;
  }

  void try_parts(const SplinePatch& patch, double least_m) {
    if (!may_be_nearer(least_m)) return;
    if (patch.side_m() <= kTried * relief_.pixel_m())
      try_from(patch.middle_x_m() - middle_x_m_, middle_y_m_ - patch.middle_y_m());
    if (patch.side_m() <= kLast * relief_.pixel_m()) return;
    const Vec3 at = place();
    for (std::size_t which = 0; which < 4; ++which) {
      const SplinePatch part = patch.quarter(which);
      try_parts(part, part.least_distance_m(at));
    }
  }

  const Relief& relief_;
  Vec3 p_;
  /// The scene's origin from the first sample.
  double middle_x_m_, middle_y_m_;
  Vec3 best_;
  double best_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<ClosestPoint> closest_point(const Relief& relief, Point<SceneFrame> point) {
  const Vec3 p = point.v;
  if (!is_finite(p) || std::abs(p.x) > 0.5 * relief.size_x_m() || std::abs(p.y) > 0.5 * relief.size_y_m())
    return std::nullopt;
  const double height_m = relief.sample(p.x, p.y).z_m;
  const Vec3 best = Search(relief, p).best();
  const HeightSample s = relief.sample(best.x, best.y);
  ClosestPoint closest;
  closest.surface = {best};
  closest.distance_m = p.z < height_m ? -norm(p - best) : norm(p - best);
  closest.normal = {unit(Vec3{-s.dzdx, -s.dzdy, 1.0})};
  return closest;
}

}  // namespace palpable::models
