// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/label_space.hpp"

#include "palpable/formats/tactile/walked_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palpable::formats {
namespace {

constexpr double kCell_m = 0.0005;
constexpr double kFartherFromOthers = 1.5;

int cells_of(double length_m) { return std::max(1, static_cast<int>(std::lround(length_m / kCell_m))); }

/// The place on a line at a part of its length, and its direction there.
struct LinePlace {
  Vec3 at;
  Vec3 along;
};

LinePlace place_on(const Polyline& line, double part) {
  double left = part * length_of(line);
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const Vec3 step = line.points[i] - line.points[i - 1];
    const double length = norm(step);
    if (length > 0.0 && (left <= length || i + 1 == line.points.size()))
      return {line.points[i - 1] + std::min(1.0, left / length) * step, (1.0 / length) * step};
    left -= length;
  }
  return {line.points.front(), {1.0, 0.0, 0.0}};
}

}  // namespace

LabelSpace::LabelSpace(double width_m, double height_m, double gap_m)
    : width_m_(width_m),
      height_m_(height_m),
      gap_m_(gap_m),
      near_(cells_of(width_m), cells_of(height_m), 0),
      taken_(cells_of(width_m), cells_of(height_m), 0) {}

template <class Visit>
bool LabelSpace::all_in(Vec3 middle, double width_m, double height_m, const Visit& visit) const {
  const auto column = [this](double x) {
    return static_cast<int>(std::floor((x + 0.5 * width_m_) / kCell_m));
  };
  const auto row = [this](double y) { return static_cast<int>(std::floor((0.5 * height_m_ - y) / kCell_m)); };
  for (int j = row(middle.y + 0.5 * height_m); j <= row(middle.y - 0.5 * height_m); ++j)
    for (int i = column(middle.x - 0.5 * width_m); i <= column(middle.x + 0.5 * width_m); ++i)
      if (!visit(i, j)) return false;
  return true;
}

void LabelSpace::add_line(const Polyline& line, double half_width_m, std::size_t owner) {
  const double reach_m = half_width_m + kFartherFromOthers * gap_m_;
  const auto number = static_cast<std::int32_t>(owner) + 1;
  walk_along(line, kCell_m, [&](Vec3 at) {
    all_in(at, 2.0 * reach_m, 2.0 * reach_m, [&](int i, int j) {
      if (i < 0 || j < 0 || i >= near_.width() || j >= near_.height()) return true;
      const double dx = (i + 0.5) * kCell_m - 0.5 * width_m_ - at.x;
      const double dy = 0.5 * height_m_ - (j + 0.5) * kCell_m - at.y;
      const double distance_m = std::hypot(dx, dy);
      if (distance_m > reach_m) return true;
      std::int32_t& near = near_(i, j);
      near = near == 0 || near == number ? number : -1;
      if (distance_m < half_width_m + gap_m_ - kCell_m) taken_(i, j) = 1;
      return true;
    });
  });
}

void LabelSpace::block(Vec3 middle, double width_m, double height_m) {
  all_in(middle, width_m, height_m, [this](int i, int j) {
    if (i >= 0 && j >= 0 && i < taken_.width() && j < taken_.height()) taken_(i, j) = 1;
    return true;
  });
}

bool LabelSpace::is_free(Vec3 middle, double width_m, double height_m,
                         std::optional<std::size_t> owner) const {
  const auto is_near_others = [&](int i, int j) {
    return owner && near_(i, j) != 0 && near_(i, j) != static_cast<std::int32_t>(*owner) + 1;
  };
  return all_in(middle, width_m, height_m, [&](int i, int j) {
    return i >= 0 && j >= 0 && i < taken_.width() && j < taken_.height() && taken_(i, j) == 0 &&
           !is_near_others(i, j);
  });
}

std::optional<Vec3> LabelSpace::take_room_near(Vec3 at, double reach_m, double box_width_m,
                                               double box_height_m,
                                               const std::function<bool(Vec3)>& accepts) {
  constexpr double kStep_m = 0.001;
  for (double radius_m = 0.0; radius_m <= reach_m; radius_m += kStep_m) {
    const int directions = std::max(1, static_cast<int>(2.0 * std::numbers::pi * radius_m / kStep_m));
    for (int k = 0; k < directions; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / directions;
      const Vec3 middle = at + radius_m * Vec3{std::cos(angle), std::sin(angle), 0.0};
      if (!is_free(middle, box_width_m, box_height_m, std::nullopt) || !accepts(middle)) continue;
      block(middle, box_width_m + 2.0 * gap_m_, box_height_m + 2.0 * gap_m_);
      return middle;
    }
  }
  return std::nullopt;
}

std::optional<Vec3> LabelSpace::take_room(const std::vector<Polyline>& lines, double half_width_m,
                                          std::size_t owner, double box_width_m, double box_height_m) {
  constexpr std::array kParts{0.5, 0.4,  0.6,  0.3,  0.7,  0.2,  0.8, 0.1,
                              0.9, 0.45, 0.55, 0.35, 0.65, 0.25, 0.75};
  for (const Polyline& line : lines)
    for (const double part : kParts) {
      const LinePlace place = place_on(line, part);
      for (const double side : {1.0, -1.0}) {
        const Vec3 across{-side * place.along.y, side * place.along.x, 0.0};
        const double box_m = 0.5 * (box_width_m * std::abs(across.x) + box_height_m * std::abs(across.y));
        const Vec3 middle = place.at + (half_width_m + gap_m_ + box_m) * across;
        if (!is_free(middle, box_width_m, box_height_m, owner)) continue;
        block(middle, box_width_m + 2.0 * gap_m_, box_height_m + 2.0 * gap_m_);
        return middle;
      }
    }
  return std::nullopt;
}

}  // namespace palpable::formats
