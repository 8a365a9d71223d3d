// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/contours/junctions.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace palpable::sculpt {
namespace {

Raster<std::uint8_t> dilated(const Raster<float>& line, int by) {
  Raster<std::uint8_t> thick(line.width(), line.height(), 0);
  for (int y = 0; y < line.height(); ++y)
    for (int x = 0; x < line.width(); ++x) {
      if (!(line(x, y) > 0.0F)) continue;
      for (int b = std::max(0, y - by); b <= std::min(line.height() - 1, y + by); ++b)
        for (int a = std::max(0, x - by); a <= std::min(line.width() - 1, x + by); ++a) thick(a, b) = 1;
    }
  return thick;
}

/// Counts the directions in which lines lead from a circle's centre to the circle within it. Arcs closer than
/// `apart_rad` to the previous one count as one direction.
class BranchCounter {
 public:
  BranchCounter(const Raster<std::uint8_t>& lines, int radius, double apart_rad)
      : lines_(lines), radius_(radius), apart_rad_(apart_rad), side_(2 * radius + 1) {
    reached_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
    const int places = static_cast<int>(std::ceil(4.0 * std::numbers::pi * radius));
    for (int k = 0; k < places; ++k) {
      const double a = 2.0 * std::numbers::pi * k / places;
      const std::pair place{static_cast<int>(std::lround(radius * std::cos(a))),
                            static_cast<int>(std::lround(radius * std::sin(a)))};
      if (ring_.empty() || ring_.back() != place) ring_.push_back(place);
    }
  }

  int parts(int x, int y) {
    flood(x, y);
    const auto arcs = arcs_reached();
    int parts = 0;
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      const double before = k > 0 ? arcs[k - 1].last : arcs.back().last - 2.0 * std::numbers::pi;
      parts += arcs[k].first - before >= apart_rad_ ? 1 : 0;
    }
    return parts;
  }

 private:
  /// Where an arc begins and ends, radians.
  struct Arc {
    double first, last;
  };
  /// In order of their angles; empty if the whole circle was reached.
  std::vector<Arc> arcs_reached() const {
    std::vector<Arc> arcs;
    const std::size_t count = ring_.size();
    const double turn = 2.0 * std::numbers::pi / static_cast<double>(count);
    const auto on = [&](std::size_t k) { return at(ring_[k % count].first, ring_[k % count].second); };
    for (std::size_t k = 0; k < count; ++k) {
      if (!on(k) || on(k + count - 1)) continue;
      std::size_t end = k;
      while (on(end + 1)) ++end;
      arcs.push_back({turn * static_cast<double>(k), turn * static_cast<double>(end)});
    }
    return arcs;
  }
  bool at(int a, int b) const { return reached_[index(a, b)] != 0; }
  std::size_t index(int a, int b) const {
    return static_cast<std::size_t>(b + radius_) * static_cast<std::size_t>(side_) +
           static_cast<std::size_t>(a + radius_);
  }
  void flood(int x, int y) {
    std::fill(reached_.begin(), reached_.end(), std::uint8_t{0});
    todo_.assign(1, {0, 0});
    reached_[index(0, 0)] = 1;
    // The ring's own pixels are rounded to within one of the circle.
    const int most2 = (radius_ + 1) * (radius_ + 1);
    while (!todo_.empty()) {
      const auto [a, b] = todo_.back();
      todo_.pop_back();
      for (const auto& [da, db] : kNeighbours) {
        const int c = a + da;
        const int d = b + db;
        if (std::abs(c) > radius_ || std::abs(d) > radius_ || c * c + d * d > most2) continue;
        const int px = x + c;
        const int py = y + d;
        if (px < 0 || py < 0 || px >= lines_.width() || py >= lines_.height()) continue;
        if (lines_(px, py) == 0 || reached_[index(c, d)] != 0) continue;
        reached_[index(c, d)] = 1;
        todo_.emplace_back(c, d);
      }
    }
  }

  static constexpr std::array<std::pair<int, int>, 4> kNeighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  const Raster<std::uint8_t>& lines_;
  int radius_;
  double apart_rad_;
  int side_;
  std::vector<std::pair<int, int>> ring_;
  std::vector<std::uint8_t> reached_;
  std::vector<std::pair<int, int>> todo_;
};

/// Removes the candidates that are connected with one of them (at most `apart_px` apart) from `parts`, and
/// returns them as one junction.
Junction taken_off(Raster<std::uint8_t>& parts, int x, int y, int apart_px) {
  Junction sum;
  int count = 0;
  std::vector<std::pair<int, int>> todo{{x, y}};
  const auto take = [&](int a, int b) {
    sum.x_px += a;
    sum.y_px += b;
    sum.branches = std::max(sum.branches, static_cast<int>(parts(a, b)));
    parts(a, b) = 0;
    ++count;
  };
  take(x, y);
  while (!todo.empty()) {
    const auto [a, b] = todo.back();
    todo.pop_back();
    for (int d = std::max(0, b - apart_px); d <= std::min(parts.height() - 1, b + apart_px); ++d)
      for (int c = std::max(0, a - apart_px); c <= std::min(parts.width() - 1, a + apart_px); ++c)
        if (parts(c, d) != 0) {
          take(c, d);
          todo.emplace_back(c, d);
        }
  }
  sum.x_px /= count;
  sum.y_px /= count;
  return sum;
}

}  // namespace

std::vector<Parameter> parameters_of(JunctionOptions& o) {
  return {{"radius_px", &o.radius_px, {3, 64}, "px", "radius of the circle that branches must reach"},
          {"least_branches", &o.least_branches, {3, 8}, "", "least branches of a junction"},
          {"bridged_px", &o.bridged_px, {0, 8}, "px", "dilation of the lines"},
          {"least_angle_degrees",
           &o.least_angle_degrees,
           {0.0, 90.0},
           "degrees",
           "least angle between two branches"}};
}

std::vector<Junction> find_junctions(const Raster<float>& line, const JunctionOptions& options) {
  PALPABLE_CHECK(check_ranges(options));
  const auto lines = dilated(line, options.bridged_px);
  BranchCounter branches(lines, options.radius_px, options.least_angle_degrees * std::numbers::pi / 180.0);
  // Number of lines that leave each candidate, 0 elsewhere.
  Raster<std::uint8_t> parts(line.width(), line.height(), 0);
  for (int y = 0; y < line.height(); ++y)
    for (int x = 0; x < line.width(); ++x)
      if (line(x, y) > 0.0F)
        if (const int n = branches.parts(x, y); n >= options.least_branches)
          parts(x, y) = static_cast<std::uint8_t>(std::min(n, 255));
  std::vector<Junction> junctions;
  for (int y = 0; y < line.height(); ++y)
    for (int x = 0; x < line.width(); ++x)
      if (parts(x, y) != 0) junctions.push_back(taken_off(parts, x, y, options.radius_px));
  return junctions;
}

Raster<std::uint8_t> mark_junctions(const std::vector<Junction>& junctions, int width, int height,
                                    double radius_px, std::uint8_t label) {
  Raster<std::uint8_t> labels(width, height, 0);
  const int reach = static_cast<int>(std::ceil(radius_px));
  for (const Junction& j : junctions) {
    const int x = static_cast<int>(std::lround(j.x_px));
    const int y = static_cast<int>(std::lround(j.y_px));
    for (int b = std::max(0, y - reach); b <= std::min(height - 1, y + reach); ++b)
      for (int a = std::max(0, x - reach); a <= std::min(width - 1, x + reach); ++a)
        if (std::hypot(a - j.x_px, b - j.y_px) <= radius_px) labels(a, b) = label;
  }
  return labels;
}

}  // namespace palpable::sculpt
