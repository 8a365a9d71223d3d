// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace palpable::sculpt {

/// Truncated signed distances on a box of voxels, each the mean of several maps.
struct FusedNumbers {
  std::array<int, 3> size{};
  /// z innermost. Where no map has a value, the truncation, positive or negative.
  std::vector<float> distance_m;
  /// How much that mean errs, squared; negative: not known (fewer than two maps have a value).
  std::vector<float> noise2_m2;

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(x) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size[2]) +
           static_cast<std::size_t>(z);
  }
};

/// Takes noise out of the distances nearer than `truncation_m`, which change linearly across a plane: each is
/// compared with the mean of its 26 neighbours, by pairs on opposite sides, and goes there by what the noise
/// explains of the difference and no farther, so what stands out of the noise stays. Every other pass goes
/// back by a little more, so that bodies do not shrink (Taubin 1995). `noise_m`: in place of what is known of
/// each voxel, if above 0. Long work: all threads, polls cancel; the same for any number of them.
void smooth(FusedNumbers& numbers, double truncation_m, double noise_m, const Work& work);

}  // namespace palpable::sculpt
