// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable {

/// A solid as the zero level of values on a regular grid, negative inside. Only the blocks near the surface
/// are stored, as in OpenVDB. Only the zero level is used: the values need not be distances.
struct LevelSet {
  static constexpr int kSide = 8;
  struct Block {
    /// Grid index of the block's first sample; each component is a multiple of kSide.
    std::array<int, 3> corner{};
    /// Samples; x varies slowest, z fastest.
    std::array<float, kSide * kSide * kSide> values{};
  };
  std::vector<Block> blocks;
  /// The value where there is no block: outside, > 0.
  float background = 0.0F;
  /// Sample (i, j, k) is at origin_m + i steps_m[0] + j steps_m[1] + k steps_m[2].
  Vec3 origin_m;
  std::array<Vec3, 3> steps_m{};
};

}  // namespace palpable
