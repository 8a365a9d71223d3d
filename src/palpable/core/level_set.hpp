// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable {

/// A solid as numbers on a regular grid, negative inside, of which only the blocks near its surface are kept
/// (as OpenVDB keeps them). Only where the numbers are 0 counts; elsewhere they need not be distances.
struct LevelSet {
  static constexpr int kSide = 8;
  struct Block {
    /// The grid place with the least coordinates, each a multiple of kSide.
    std::array<int, 3> corner{};
    /// x outermost, z innermost.
    std::array<float, kSide * kSide * kSide> values{};
  };
  std::vector<Block> blocks;
  /// Wherever there is no block: outside, > 0.
  float background = 0.0F;
  /// Grid place (i, j, k) stands at origin_m + i steps_m[0] + j steps_m[1] + k steps_m[2].
  Vec3 origin_m;
  std::array<Vec3, 3> steps_m{};
};

}  // namespace palpable
