// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/what_is_ahead.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::session {
namespace {

constexpr double kCell_m = 0.05;
constexpr int kAhead = 60, kAcross = 120;
constexpr double kFarthest_m = 2.5;
/// What is lower is floor, as for RobotMap.
constexpr double kStep_m = 0.025, kStepPerMetre = 0.015;
constexpr int kMostReadings = 120;

/// What readings show in a cell of the floor plan.
struct Cell {
  int readings = 0;
  float lowest_m = std::numeric_limits<float>::infinity();
  float highest_m = 0.0F;
  bool at_top = false, at_side = false;
};

/// The floor plan before the camera: rows ahead, columns from the left.
class Plan {
 public:
  Plan(const DepthMap& depth, const RobotShape& shape) : cells_(kAcross, kAhead) {
    const Pinhole& camera = *depth.camera;
    const double down_sin = std::sin(shape.camera_down_rad), down_cos = std::cos(shape.camera_down_rad);
    const int width = depth.depth_m.width(), height = depth.depth_m.height();
    const int step = std::max(1, std::max(width, height) / kMostReadings);
    for (int v = step / 2; v < height; v += step)
      for (int u = step / 2; u < width; u += step) {
        const double z = double{depth.depth_m(u, v)};
        if (!(z > 0.0)) continue;
        const double right_m = z * (u - camera.cx) / camera.fx - shape.camera_left_m;
        const double below_m = z * (v - camera.cy) / camera.fy;
        const double ahead_m = z * down_cos - below_m * down_sin;
        const double up_m = shape.camera_height_m - z * down_sin - below_m * down_cos;
        if (up_m < kStep_m + kStepPerMetre * ahead_m) continue;
        const int row = static_cast<int>(ahead_m / kCell_m);
        const int column = static_cast<int>(std::floor(right_m / kCell_m)) + kAcross / 2;
        if (ahead_m < 0.0 || row >= kAhead || column < 0 || column >= kAcross) continue;
        add(cells_(column, row), static_cast<float>(up_m), v < 2 * step,
            u < 2 * step || u >= width - 2 * step);
      }
  }

  bool is_filled(int column, int row) const {
    constexpr int kLeast = 2;
    return column >= 0 && row >= 0 && column < kAcross && row < kAhead && at(column, row).readings >= kLeast;
  }
  const Cell& at(int column, int row) const { return cells_(column, row); }

 private:
  static void add(Cell& cell, float up_m, bool at_top, bool at_side) {
    ++cell.readings;
    cell.lowest_m = std::min(cell.lowest_m, up_m);
    cell.highest_m = std::max(cell.highest_m, up_m);
    cell.at_top = cell.at_top || at_top;
    cell.at_side = cell.at_side || at_side;
  }
  Raster<Cell> cells_;
};

/// The filled cells that hang together with a first one, in rows before `rows`; up to two empty ones may be
/// between them.
class Group {
 public:
  Group(const Plan& plan, int column, int row, int rows) {
    nearest_.fill(kAhead);
    lowest_m_.fill(std::numeric_limits<float>::infinity());
    std::vector<std::pair<int, int>> open{{column, row}};
    Raster<char> taken(kAcross, kAhead);
    taken(column, row) = 1;
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      take(plan.at(x, y), x, y);
      constexpr int kReach = 3;
      for (int j = y - kReach; j <= std::min(y + kReach, rows - 1); ++j)
        for (int i = x - kReach; i <= x + kReach; ++i) {
          if (!plan.is_filled(i, j) || taken(i, j) != 0) continue;
          taken(i, j) = 1;
          open.emplace_back(i, j);
        }
    }
  }

  double width_m() const { return kCell_m * (last_ - first_ + 1); }
  bool is_wider() const { return at_side_; }
  std::optional<double> top_m() const { return at_top_ ? std::nullopt : std::optional(double{top_m_}); }
  /// Most of its width stands on nothing.
  bool is_open_below() const {
    constexpr double kOpen = 0.6;
    int open = 0, all = 0;
    for (int i = first_; i <= last_; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (nearest_[k] == kAhead) continue;
      ++all;
      open += double{lowest_m_[k]} > kOpen * double{top_m_} ? 1 : 0;
    }
    return 2 * open > all;
  }
  /// The nearest cells of its columns lie on a line, to a cell.
  bool is_plane() const {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for_each_nearest([&](double i, double j) { n += 1.0, x += i, y += j, xx += i * i, xy += i * j; });
    const double spread = xx - x * x / n;
    if (n < 3.0 || !(spread > 0.0)) return false;
    const double slope = (xy - x * y / n) / spread;
    double off = 0.0;
    for_each_nearest([&](double i, double j) {
      const double away = j - y / n - slope * (i - x / n);
      off += away * away;
    });
    return off / n < 1.0 + slope * slope;
  }

 private:
  void take(const Cell& cell, int column, int row) {
    const auto k = static_cast<std::size_t>(column);
    first_ = std::min(first_, column);
    last_ = std::max(last_, column);
    nearest_[k] = std::min(nearest_[k], row);
    lowest_m_[k] = std::min(lowest_m_[k], cell.lowest_m);
    top_m_ = std::max(top_m_, cell.highest_m);
    at_top_ = at_top_ || cell.at_top;
    at_side_ = at_side_ || cell.at_side;
  }
  template <class Take>
  void for_each_nearest(const Take& take) const {
    for (int i = first_; i <= last_; ++i)
      if (const int row = nearest_[static_cast<std::size_t>(i)]; row < kAhead)
        take(static_cast<double>(i), static_cast<double>(row));
  }

  std::array<int, kAcross> nearest_{};
  std::array<float, kAcross> lowest_m_{};
  float top_m_ = 0.0F;
  int first_ = kAcross, last_ = 0;
  bool at_top_ = false, at_side_ = false;
};

constexpr double kWallWidth_m = 1.2, kWallTop_m = 1.5;
constexpr double kTableWidth_m = 0.5, kTableLow_m = 0.45, kTableHigh_m = 1.1;

bool is_wall(const Group& group) {
  return group.width_m() >= kWallWidth_m && group.top_m().value_or(kWallTop_m) >= kWallTop_m &&
         group.is_plane() && !group.is_open_below();
}

bool is_table(const Group& group) {
  const auto top_m = group.top_m();
  return top_m && *top_m >= kTableLow_m && *top_m <= kTableHigh_m && group.width_m() >= kTableWidth_m &&
         group.is_open_below();
}

int in_steps(double metres, int step_cm) {
  return step_cm * static_cast<int>(std::lround(100.0 * metres / step_cm));
}

}  // namespace

std::optional<ThingAhead> thing_ahead(const DepthMap& depth, const RobotShape& shape) {
  if (!depth.camera) return std::nullopt;
  const Plan plan(depth, shape);
  const int half = static_cast<int>(std::ceil(shape.radius_m / kCell_m));
  const double before_m = shape.camera_forward_m - shape.radius_m;
  for (int row = 0; row < kAhead && kCell_m * row + before_m < kFarthest_m; ++row)
    for (int column = kAcross / 2 - half; column < kAcross / 2 + half; ++column) {
      if (!plan.is_filled(column, row)) continue;
      ThingAhead thing;
      thing.distance_m = std::max(0.0, kCell_m * (row + 0.5) + before_m);
      const Group all(plan, column, row, kAhead);
      // What stands before a wall hangs together with it; so a thing is what is near its nearest part.
      constexpr int kDepth = 10;
      const Group group = is_wall(all) ? all : Group(plan, column, row, row + kDepth);
      thing.kind = is_wall(group) ? ThingKind::wall : is_table(group) ? ThingKind::table : ThingKind::other;
      thing.width_m = group.width_m();
      thing.is_wider = group.is_wider();
      thing.top_m = group.top_m();
      return thing;
    }
  return std::nullopt;
}

std::string sentence_of(const ThingAhead& thing) {
  constexpr int kStep_cm = 5;
  const int distance_cm = in_steps(thing.distance_m, kStep_cm);
  if (thing.kind == ThingKind::wall) return fmt::format("A wall, {} cm ahead.", distance_cm);
  return fmt::format(
      "{}, {} cm ahead: {}{} cm wide, {}.", thing.kind == ThingKind::table ? "A table" : "Something",
      distance_cm, thing.is_wider ? "at least " : "", in_steps(thing.width_m, kStep_cm),
      thing.top_m ? fmt::format("{} cm high", in_steps(*thing.top_m, kStep_cm)) : "higher than the picture");
}

std::optional<std::string> AheadWatch::look(double t_s, const DepthMap& depth, const RobotShape& shape,
                                            bool stands) {
  if (!stands) {
    seen_.reset();
    return std::nullopt;
  }
  const auto thing = thing_ahead(depth, shape);
  const auto before = std::exchange(seen_, thing ? std::optional(thing->kind) : std::nullopt);
  // One picture alone may show a thing in part.
  if (!thing || before != thing->kind) return std::nullopt;
  constexpr double kElsewhere = 0.25, kLeast_m = 0.1, kPause_s = 2.0;
  const bool is_same =
      said_ && said_->kind == thing->kind &&
      std::abs(said_->distance_m - thing->distance_m) <= std::max(kLeast_m, kElsewhere * said_->distance_m);
  if (is_same || (said_ && t_s - said_at_s_ < kPause_s)) return std::nullopt;
  said_ = thing;
  said_at_s_ = t_s;
  return sentence_of(*thing);
}

}  // namespace palpable::session
