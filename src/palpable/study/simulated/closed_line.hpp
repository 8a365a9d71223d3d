// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/vec3.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::study {

/// A line through points of the plane z = 0 (scene frame, m), by the way along it.
class LineByLength {
 public:
  /// `points`: at least two, none twice in a row. A closed line goes on from the last to the first.
  enum class Ends { open, closed };
  LineByLength(std::vector<Vec3> points, Ends ends);

  double length_m() const { return at_m_.back(); }
  /// Held at the ends of an open line; a closed one goes round again.
  Vec3 point(double along_m) const;
  /// The way along to the place nearest to `p` within [from_m, to_m].
  double nearest(Vec3 p, double from_m, double to_m) const;
  /// The next way along beyond `along_m` at which the line turns by more than 30 degrees at once; beyond its
  /// length if there is none.
  double next_corner(double along_m) const;
  const std::vector<Vec3>& points() const { return points_; }

 private:
  std::vector<Vec3> points_;
  /// Where each point stands, and the end.
  std::vector<double> at_m_;
  std::vector<double> corners_m_;
  bool closed_;
};

/// A grid of square pixels over a rectangle round the origin.
struct MaskGrid {
  int width = 0;
  int height = 0;
  double pixel_m = 0.0;
};

/// 1 at the pixels whose middle lies inside the closed line (even-odd rule), 0 outside.
Raster<std::uint8_t> inside_of(const std::vector<Vec3>& line, const MaskGrid& grid);

/// e = S'/S (graphic-haptic display 2006): the area between a trace and the nominal line over the nominal's
/// own, on pixels of 0.1 mm. NaN if the nominal line encloses nothing.
double area_error(const std::vector<Vec3>& trace, const std::vector<Vec3>& nominal);

/// Mean turn from step to step, degrees a millimetre: the smaller, the smoother.
double roughness_deg_per_mm(const std::vector<Vec3>& trace);

}  // namespace palpable::study
