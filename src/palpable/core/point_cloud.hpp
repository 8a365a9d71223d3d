// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <vector>

namespace palpable {

/// Places on surfaces, metres.
struct PointCloud {
  std::vector<Vec3> places_m;
  /// Unit normals that face out of the solid; empty where they are not known, or as many as the places.
  std::vector<Vec3> normals;
};

}  // namespace palpable
