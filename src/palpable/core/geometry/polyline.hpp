// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <vector>

namespace palpable {

/// A polyline in the plane z = 0 of the scene, metres. If closed, the last point is connected to the first.
struct Polyline {
  std::vector<Vec3> points;
  bool closed = false;
};

/// Length of a polyline, metres.
inline double length_of(const Polyline& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) sum += norm(line.points[i] - line.points[i - 1]);
  if (line.closed && line.points.size() > 1) sum += norm(line.points.front() - line.points.back());
  return sum;
}

}  // namespace palpable
