// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/drive.hpp"

#include "palpable/core/picture/raster.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <random>

namespace palpable::study {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kPi = std::numbers::pi;

/// Free places of the floor, and shortest ways between them.
class FreeFloor {
 public:
  FreeFloor(const Room& room, double radius_m)
      : room_(room),
        free_(static_cast<int>(room.size_m.x / kCell_m), static_cast<int>(room.size_m.y / kCell_m), 0) {
    for (int y = 0; y < free_.height(); ++y)
      for (int x = 0; x < free_.width(); ++x) {
        const Vec3 p = place({x, y});
        free_(x, y) = touches(room, {p.x, p.y, radius_m}) ? 0 : 1;
      }
  }

  /// Removes the places that cannot be reached from `from`.
  void keep_reached(Pixel from) {
    const Raster<int> back = ways_from(from, std::nullopt);
    for (std::size_t k = 0; k < back.count(); ++k)
      if (back.values()[k] == kNoWay) free_.values()[k] = 0;
  }

  Vec3 place(Pixel c) const {
    return {(c.x + 0.5) * kCell_m - room_.size_m.x / 2.0, (c.y + 0.5) * kCell_m - room_.size_m.y / 2.0, 0.0};
  }

  /// The cells from `from` to `to`, without the first; empty if there is no way.
  std::vector<Pixel> way(Pixel from, Pixel to) const {
    const Raster<int> back = ways_from(from, to);
    std::vector<Pixel> cells;
    if (back(to.x, to.y) == kNoWay) return cells;
    for (Pixel c = to; c != from; c = neighbour(c, back(c.x, c.y))) cells.push_back(c);
    std::reverse(cells.begin(), cells.end());
    return cells;
  }

  /// The outermost free cell in this direction from the room's middle.
  std::optional<Pixel> outermost(double angle_rad) const {
    for (double r = std::hypot(room_.size_m.x, room_.size_m.y) / 2.0; r > 0.3; r -= kCell_m) {
      const Pixel c = cell(r * std::cos(angle_rad), r * std::sin(angle_rad));
      if (free_.contains(c.x, c.y) && free_(c.x, c.y) == 1) return c;
    }
    return std::nullopt;
  }

  std::optional<Pixel> any() const {
    for (double r = 0.0; r < 2.0; r += kCell_m)
      for (double a = 0.0; a < 2.0 * kPi; a += 0.3) {
        const Pixel c = cell(r * std::cos(a), r * std::sin(a));
        if (free_.contains(c.x, c.y) && free_(c.x, c.y) == 1) return c;
      }
    return std::nullopt;
  }

 private:
  static constexpr int kNoWay = -1;

  /// For each cell that is reached from `from`, the neighbour (0 ... 7) through which; others kNoWay. Ends at
  /// `to`, if given.
  Raster<int> ways_from(Pixel from, std::optional<Pixel> to) const {
    Raster<int> back(free_.width(), free_.height(), kNoWay);
    std::deque<Pixel> front{from};
    back(from.x, from.y) = 0;
    while (!front.empty() && !(to && back(to->x, to->y) != kNoWay)) {
      const Pixel c = front.front();
      front.pop_front();
      for (int k = 0; k < 8; ++k) {
        const Pixel n = neighbour(c, k);
        if (!free_.contains(n.x, n.y) || free_(n.x, n.y) == 0 || back(n.x, n.y) != kNoWay) continue;
        back(n.x, n.y) = (k + 4) % 8;
        front.push_back(n);
      }
    }
    return back;
  }
  static Pixel neighbour(Pixel c, int k) {
    constexpr int kX[] = {1, 1, 0, -1, -1, -1, 0, 1};
    constexpr int kY[] = {0, 1, 1, 1, 0, -1, -1, -1};
    return {c.x + kX[k], c.y + kY[k]};
  }
  Pixel cell(double x_m, double y_m) const {
    return {static_cast<int>(std::floor((x_m + room_.size_m.x / 2.0) / kCell_m)),
            static_cast<int>(std::floor((y_m + room_.size_m.y / 2.0) / kCell_m))};
  }

  const Room& room_;
  Raster<std::uint8_t> free_;
};

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * kPi); }

/// The poses along a polyline: a turn towards a place some way ahead, then on by one step.
std::vector<PlanarPose> followed(const std::vector<Vec3>& path, const DriveOptions& o) {
  constexpr std::size_t kAhead = 5;
  const double step_m = o.speed_m_per_s / o.rate_hz;
  const double turn = o.turn_rad_per_s / o.rate_hz;
  std::vector<PlanarPose> poses;
  PlanarPose p{path[0].x, path[0].y, 0.0};
  const auto heading_to = [&](std::size_t k) {
    const Vec3 d = path[std::min(k, path.size() - 1)] - Vec3{p.x_m, p.y_m, 0.0};
    return std::atan2(d.y, d.x);
  };
  p.heading_rad = heading_to(kAhead);
  poses.push_back(p);
  double gone_m = 0.0;
  for (std::size_t k = 1; k < path.size();) {
    const double off = wrapped(heading_to(k + kAhead) - p.heading_rad);
    p.heading_rad = wrapped(p.heading_rad + std::clamp(off, -turn, turn));
    // On the path itself, since only that is free; slower in curves.
    if (std::abs(off) < 1.0) gone_m += step_m * std::max(0.2, std::cos(off));
    for (; k < path.size(); ++k) {
      const double length = norm(path[k] - path[k - 1]);
      if (gone_m < length) break;
      gone_m -= length;
    }
    const std::size_t at = std::min(k, path.size() - 1);
    const Vec3 d = path[at] - path[at - 1];
    const Vec3 q = k < path.size() ? path[at - 1] + (gone_m / norm(d)) * d : path[at];
    p.x_m = q.x, p.y_m = q.y;
    poses.push_back(p);
  }
  return poses;
}

}  // namespace

std::vector<PlanarPose> drive_round(const Room& room, const DriveOptions& options) {
  FreeFloor floor(room, options.radius_m);
  const auto middle = floor.any();
  if (!middle) return {};
  floor.keep_reached(*middle);
  constexpr int kCorners = 12;
  std::vector<Pixel> corners;
  for (int k = 0; k <= kCorners; ++k)
    if (const auto c = floor.outermost(-2.35 + 2.0 * kPi * k / kCorners)) corners.push_back(*c);
  if (corners.size() < 4) return {};
  std::vector<Vec3> path{floor.place(corners[0])};
  for (std::size_t k = 1; k < corners.size(); ++k)
    for (const Pixel c : floor.way(corners[k - 1], corners[k])) path.push_back(floor.place(c));
  return followed(path, options);
}

std::vector<PlanarPose> odometry_of(const std::vector<PlanarPose>& drive, const WheelNoise& noise,
                                    std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const double distance_scale = 1.0 + noise.distance_scale * normal(engine);
  const double turn_scale = 1.0 + noise.turn_scale * normal(engine);
  std::vector<PlanarPose> said;
  for (std::size_t k = 0; k < drive.size(); ++k) {
    if (k == 0) {
      said.push_back(drive[0]);
      continue;
    }
    const PlanarPose& a = drive[k - 1];
    const PlanarPose& b = drive[k];
    PlanarPose p = said.back();
    const double forward =
        std::cos(a.heading_rad) * (b.x_m - a.x_m) + std::sin(a.heading_rad) * (b.y_m - a.y_m);
    const double left = std::cos(a.heading_rad) * (b.y_m - a.y_m) - std::sin(a.heading_rad) * (b.x_m - a.x_m);
    const double turn = wrapped(b.heading_rad - a.heading_rad);
    const double gone = std::hypot(forward, left);
    const double f = distance_scale * forward + noise.m_per_root_m * std::sqrt(gone) * normal(engine);
    const double l = distance_scale * left;
    p.x_m += std::cos(p.heading_rad) * f - std::sin(p.heading_rad) * l;
    p.y_m += std::sin(p.heading_rad) * f + std::cos(p.heading_rad) * l;
    p.heading_rad =
        wrapped(p.heading_rad + turn_scale * turn + noise.rad_per_root_m * std::sqrt(gone) * normal(engine) +
                noise.rad_per_root_rad * std::sqrt(std::abs(turn)) * normal(engine));
    said.push_back(p);
  }
  return said;
}

}  // namespace palpable::study
