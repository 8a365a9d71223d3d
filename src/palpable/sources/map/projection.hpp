// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/sources/map/extract_window.hpp"

#include <cmath>
#include <numbers>

namespace palpable::sources {

/// How far east a meridian is of another one, the shorter way round: -180 ... 180 degrees.
inline double east_of(double longitude, double other) { return std::remainder(longitude - other, 360.0); }

/// Equirectangular with true scale at the window's centre: pixels, y down.
class Projection {
 public:
  Projection(GeoPoint center, const ExtractWindow& window)
      : center_(center),
        px_per_degree_(kMetresPerDegree * window.side_px / window.width_m),
        shrink_(std::cos(center.latitude * std::numbers::pi / 180.0)),
        middle_(0.5 * (window.side_px - 1)) {}

  MapPoint operator()(GeoPoint p) const {
    return {middle_ + east_of(p.longitude, center_.longitude) * shrink_ * px_per_degree_,
            middle_ - (p.latitude - center_.latitude) * px_per_degree_};
  }

 private:
  static constexpr double kMetresPerDegree = 111195.0;
  GeoPoint center_;
  double px_per_degree_;
  double shrink_;
  double middle_;
};

}  // namespace palpable::sources
