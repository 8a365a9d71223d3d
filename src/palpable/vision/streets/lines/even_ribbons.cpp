// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/even_ribbons.hpp"

#include "palpable/vision/streets/lines/beside_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::vision {
namespace {

/// Part of a line's length that has a street of the mask behind one border, for the side where it is more.
double part_beside(const CentreLine& line, const Raster<std::uint8_t>& streets, double beside_px) {
  constexpr std::size_t kAround = 3;
  const auto& p = line.points;
  std::array<int, 2> seen{};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const MapPoint normal = normal_at(p, i, kAround);
    for (std::size_t side = 0; side < 2; ++side) {
      bool is_street = false;
      for (double d = line.radius_px; d <= line.radius_px + beside_px && !is_street; d += 1.0)
        is_street = value_at(streets, beside(p[i], normal, side == 0 ? d : -d)) != 0;
      seen[side] += is_street ? 1 : 0;
    }
  }
  return std::max(seen[0], seen[1]) / static_cast<double>(p.size());
}

bool is_ribbon(const Raster<Rgb8>& picture, const CentreLine& line, const EvenRibbonOptions& options,
               const CasingOptions& casings) {
  if (length_px(line.points) < options.least_length_widths * 2.0 * line.radius_px ||
      line.radius_spread_px > options.most_width_spread * line.radius_px)
    return false;
  const CasedParts parts = cased_parts(picture, line, casings);
  return std::min(parts.left, parts.right) >= options.least_side_part;
}

}  // namespace

std::vector<Parameter> parameters_of(EvenRibbonOptions& o) {
  return {{"least_length_widths", &o.least_length_widths, {0, 100}, "widths", "shortest ribbon"},
          {"most_width_spread", &o.most_width_spread, {0, 2}, "", "spread of its width, as a part of it"},
          {"least_side_part", &o.least_side_part, {0, 1}, "", "part of each of its sides with casings"},
          {"least_even_part", &o.least_even_part, {0, 1}, "", "part of a colour's ribbons of one width"},
          {"same_radius", &o.same_radius, {0, 1}, "", "difference from that of the map's streets"},
          {"beside_px", &o.beside_px, {0, 20}, "px", "distance of a street beside a strip"},
          {"most_beside_part", &o.most_beside_part, {0, 1}, "", "part of a ribbon beside a street"}};
}

CentreLines even_ribbons(const Raster<Rgb8>& picture, const CentreLines& lines,
                         const Raster<std::uint8_t>& streets, std::span<const double> street_radii_px,
                         const EvenRibbonOptions& options, const CasingOptions& casings) {
  CentreLines out = lines;
  std::erase_if(out.lines,
                [&](const CentreLine& line) { return !is_ribbon(picture, line, options, casings); });
  double all = 0.0;
  for (const CentreLine& line : out.lines) all += length_px(line.points);
  const auto differs = [&options](const CentreLine& line, double radius) {
    return std::abs(line.radius_px - radius) > options.same_radius * radius;
  };
  double best = 0.0;
  double most = 0.0;
  for (const double radius : street_radii_px) {
    double length = 0.0;
    for (const CentreLine& line : out.lines) length += differs(line, radius) ? 0.0 : length_px(line.points);
    if (length > most) {
      most = length;
      best = radius;
    }
  }
  if (most < options.least_even_part * all) best = 0.0;
  std::erase_if(out.lines, [&](const CentreLine& line) {
    return best == 0.0 || differs(line, best) ||
           part_beside(line, streets, options.beside_px) > options.most_beside_part;
  });
  join_lines(out);
  return out;
}

}  // namespace palpable::vision
