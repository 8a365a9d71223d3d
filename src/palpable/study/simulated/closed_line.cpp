// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/closed_line.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpable::study {
namespace {

double turn_rad(Vec3 a, Vec3 b) { return std::abs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y)); }

}  // namespace

LineByLength::LineByLength(std::vector<Vec3> points, Ends ends)
    : points_(std::move(points)), closed_(ends == Ends::closed) {
  PALPABLE_CHECK(points_.size() >= 2);
  if (closed_) points_.push_back(points_.front());
  at_m_.push_back(0.0);
  for (std::size_t k = 1; k < points_.size(); ++k)
    at_m_.push_back(at_m_.back() + norm(points_[k] - points_[k - 1]));
  constexpr double kCorner_rad = std::numbers::pi / 6.0;
  for (std::size_t k = 1; k + 1 < points_.size(); ++k)
    if (turn_rad(points_[k] - points_[k - 1], points_[k + 1] - points_[k]) > kCorner_rad)
      corners_m_.push_back(at_m_[k]);
}

Vec3 LineByLength::point(double along_m) const {
  const double length = length_m();
  double s = std::clamp(along_m, 0.0, length);
  if (closed_) s = along_m - length * std::floor(along_m / length);
  const auto after = std::upper_bound(at_m_.begin() + 1, at_m_.end() - 1, s) - at_m_.begin();
  const auto k = static_cast<std::size_t>(after);
  const double f = (s - at_m_[k - 1]) / (at_m_[k] - at_m_[k - 1]);
  return points_[k - 1] + f * (points_[k] - points_[k - 1]);
}

double LineByLength::nearest(Vec3 p, double from_m, double to_m) const {
  constexpr double kStep_m = 0.0001;
  double best = from_m;
  double least = std::numeric_limits<double>::infinity();
  const int steps = std::max(1, static_cast<int>((to_m - from_m) / kStep_m));
  for (int k = 0; k <= steps; ++k) {
    const double s = from_m + (to_m - from_m) * k / steps;
    const double d = squared_norm(point(s) - p);
    if (d < least) {
      least = d;
      best = s;
    }
  }
  return best;
}

double LineByLength::next_corner(double along_m) const {
  const auto found = std::upper_bound(corners_m_.begin(), corners_m_.end(), along_m);
  return found != corners_m_.end() ? *found : std::numeric_limits<double>::infinity();
}

Raster<std::uint8_t> inside_of(const std::vector<Vec3>& line, const MaskGrid& grid) {
  Raster<std::uint8_t> mask(grid.width, grid.height, 0);
  std::vector<double> crossings;
  for (int row = 0; row < grid.height; ++row) {
    const double y = (0.5 * (grid.height - 1) - row) * grid.pixel_m;
    crossings.clear();
    for (std::size_t k = 0; k < line.size(); ++k) {
      const Vec3 a = line[k];
      const Vec3 b = line[(k + 1) % line.size()];
      if ((a.y > y) != (b.y > y)) crossings.push_back(a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      for (int i = 0; i < grid.width; ++i) {
        const double x = (i - 0.5 * (grid.width - 1)) * grid.pixel_m;
        if (x >= crossings[k] && x < crossings[k + 1]) mask(i, row) = 1;
      }
  }
  return mask;
}

double area_error(const std::vector<Vec3>& trace, const std::vector<Vec3>& nominal) {
  constexpr double kPixel_m = 0.0001;
  double reach_m = 0.0;
  for (const auto* line : {&trace, &nominal})
    for (const Vec3& p : *line) reach_m = std::max({reach_m, std::abs(p.x), std::abs(p.y)});
  const int side = 2 * static_cast<int>(std::ceil(reach_m / kPixel_m)) + 2;
  const MaskGrid grid{side, side, kPixel_m};
  const auto a = inside_of(trace, grid);
  const auto b = inside_of(nominal, grid);
  std::int64_t between = 0;
  std::int64_t within = 0;
  for (std::size_t k = 0; k < a.count(); ++k) {
    between += a.values()[k] != b.values()[k] ? 1 : 0;
    within += b.values()[k];
  }
  return within > 0 ? static_cast<double>(between) / static_cast<double>(within)
                    : std::numeric_limits<double>::quiet_NaN();
}

double roughness_deg_per_mm(const std::vector<Vec3>& trace) {
  double turned = 0.0;
  double length_m = 0.0;
  for (std::size_t k = 1; k + 1 < trace.size(); ++k) {
    turned += turn_rad(trace[k] - trace[k - 1], trace[k + 1] - trace[k]);
    length_m += norm(trace[k] - trace[k - 1]);
  }
  return length_m > 0.0 ? turned * 180.0 / std::numbers::pi / (1000.0 * length_m) : 0.0;
}

}  // namespace palpable::study
