// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests of occupancy grids: a scene with one grid.

#include "palpable/models/scene/scene.hpp"

#include <functional>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::models {

/// A grid with 1 mm spacing from (-0.01, -0.01, -0.001) m on. `occupied` decides by the index along z; the
/// view from above is a level relief of height `height_m`.
inline Scene grid_scene(std::array<int, 3> counts, float height_m,
                        const std::function<bool(int z)>& occupied) {
  auto relief = Relief::from_samples(Raster<float>(counts[0] - 1, counts[1] - 1, height_m), 0.001);
  EXPECT_TRUE(relief.has_value());
  Occupancy o;
  o.counts = counts;
  o.origin_m = {-0.01, -0.01, -0.001};
  o.spacing_m = 0.001;
  for (int z = 0; z < counts[2]; ++z)
    for (int i = 0; i < counts[0] * counts[1]; ++i) o.occupied.push_back(occupied(z) ? 1 : 0);
  auto grid = OccupancyGrid::from(o, Work{});
  EXPECT_TRUE(grid.has_value());
  Scene scene;
  scene.model = std::make_shared<const Grid>(
      Grid{*std::move(grid), std::make_shared<const Relief>(*std::move(relief))});
  return scene;
}

}  // namespace palpable::models
