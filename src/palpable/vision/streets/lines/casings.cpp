// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/casings.hpp"

#include "palpable/vision/streets/lines/beside_line.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::vision {
namespace {

bool is_inside(const Raster<Rgb8>& picture, double x, double y) {
  return picture.contains(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
}

/// The grey level of the nearest pixel; that of the border outside the picture.
double luma_at(const Raster<Rgb8>& picture, double x, double y) {
  const int column = std::clamp(static_cast<int>(std::lround(x)), 0, picture.width() - 1);
  const int row = std::clamp(static_cast<int>(std::lround(y)), 0, picture.height() - 1);
  const Rgb8 c = picture(column, row);
  return 0.299 * c.r + 0.587 * c.g + 0.114 * c.b;
}

}  // namespace

CasedParts cased_parts(const Raster<Rgb8>& picture, const CentreLine& line, const CasingOptions& options) {
  const auto& p = line.points;
  int all = 0;
  CasedParts cased;
  const auto step = static_cast<std::size_t>(options.step_points);
  const auto reach = static_cast<std::size_t>(options.direction_points);
  for (std::size_t i = 0; i < p.size(); i += step) {
    const MapPoint across = normal_at(p, i, reach);
    const auto at = [&](double v) { return luma_at(picture, p[i].x + v * across.x, p[i].y + v * across.y); };
    bool is_cased = false;
    for (const double side : {-1.0, 1.0}) {
      const double inside = at(side * std::max(0.0, line.radius_px - options.inside_px));
      double border = inside;
      for (double v = line.radius_px - options.casing_inside_px;
           v <= line.radius_px + options.casing_outside_px; v += 0.5)
        border = std::min(border, at(side * v));
      // What is outside of the picture may have a casing.
      const double beyond = side * (line.radius_px + options.beside_px);
      const bool is_known = is_inside(picture, p[i].x + beyond * across.x, p[i].y + beyond * across.y);
      // Lettering beside the street is dark as well.
      const double outside = std::max(at(side * (line.radius_px + options.beside_px)),
                                      at(side * (line.radius_px + options.far_beside_px)));
      const bool is_bare =
          border + options.least_contrast > std::min(inside, outside) && outside + options.dark_land > inside;
      if (is_known && is_bare) continue;
      (side < 0.0 ? cased.left : cased.right) += 1.0;
      is_cased = is_cased || !is_bare;
    }
    ++all;
    cased.any += is_cased ? 1.0 : 0.0;
  }
  for (double* part : {&cased.left, &cased.right, &cased.any}) *part /= std::max(1, all);
  return cased;
}

}  // namespace palpable::vision
