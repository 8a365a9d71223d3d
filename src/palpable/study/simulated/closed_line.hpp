// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/vec3.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::study {

/// A polyline in the plane z = 0 (scene frame, m), parametrised by arc length.
class LineByLength {
 public:
  /// `points`: at least two, neighbours different. A closed line continues from the last point to the first.
  enum class Ends { open, closed };
  LineByLength(std::vector<Vec3> points, Ends ends);

  double length_m() const { return at_m_.back(); }
  /// The point at this arc length: clamped to the ends of an open line, periodic on a closed one.
  Vec3 point(double along_m) const;
  /// The arc length in [from_m, to_m] of the point nearest to `p`.
  double nearest(Vec3 p, double from_m, double to_m) const;
  /// The arc length of the next corner beyond `along_m`, where the line turns by more than 30 degrees;
  /// infinity if there is none.
  double next_corner(double along_m) const;
  const std::vector<Vec3>& points() const { return points_; }

 private:
  std::vector<Vec3> points_;
  /// The arc length at each point and at the end.
  std::vector<double> at_m_;
  std::vector<double> corners_m_;
  bool closed_;
};

/// A grid of square pixels over a rectangle centred at the origin.
struct MaskGrid {
  int width = 0;
  int height = 0;
  double pixel_m = 0.0;
};

/// 1 at the pixels whose centre lies inside the closed line (even-odd rule), 0 outside.
Raster<std::uint8_t> inside_of(const std::vector<Vec3>& line, const MaskGrid& grid);

/// e = S'/S (graphic-haptic display 2006): the area between a trace and the nominal line, divided by the area
/// inside the nominal line, on pixels of 0.1 mm. NaN if the nominal line encloses no area.
double area_error(const std::vector<Vec3>& trace, const std::vector<Vec3>& nominal);

/// Total turning angle of a trace divided by its length, degrees per millimetre: the smaller, the smoother.
double roughness_deg_per_mm(const std::vector<Vec3>& trace);

}  // namespace palpable::study
