// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <vector>

namespace palpable {

/// Points on surfaces, metres.
struct PointCloud {
  std::vector<Vec3> places_m;
  /// Unit normals that point out of the solid; empty if unknown, else one per point.
  std::vector<Vec3> normals;
};

}  // namespace palpable
