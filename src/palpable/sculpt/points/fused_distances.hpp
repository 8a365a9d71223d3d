// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace palpable::sculpt {

/// Truncated signed distances on a box of voxels, each the mean over several maps.
struct FusedDistances {
  std::array<int, 3> size{};
  /// z innermost. Plus or minus the truncation if no map has a value.
  std::vector<float> distance_m;
  /// Variance of that mean; negative = unknown (fewer than two maps have a value).
  std::vector<float> variance_m2;

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(x) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size[2]) +
           static_cast<std::size_t>(z);
  }
};

/// How the noise of fused distances is smoothed. Chosen on a plane, a ball and a box with noise of 0.3
/// voxels.
struct SmoothingOptions {
  /// Standard deviation of a voxel's distance, metres; 0 = each voxel's own, from the maps' disagreement.
  /// 0 … 1.
  double noise_m = 0.0;
  /// Number of passes, alternately forward and backward. 0 … 1000.
  int passes = 12;
  /// Share of the explained difference by which a forward pass moves a distance, and by which a backward pass
  /// moves it away again (Taubin's lambda and -mu). 0 … 1 each.
  double forward = 0.6;
  double backward = 0.63;
  /// Differences up to this many standard deviations count as noise. 0 … 100.
  double explained_deviations = 3.0;
};

std::vector<Parameter> parameters_of(SmoothingOptions& options);

/// Smooths distances nearer than `truncation_m`, which are linear across a plane. Each is compared with the
/// mean of its 26 neighbours (in opposite pairs), and moves towards it by the share of the difference that
/// the noise explains, so larger features remain. Every other pass moves it back by a little more, so that
/// bodies do not shrink (Taubin 1995). The options must be in their ranges. Long work: all threads, polls
/// cancel; the result does not depend on the number of threads.
void smooth(FusedDistances& fused, double truncation_m, const SmoothingOptions& options, const Work& work);

}  // namespace palpable::sculpt
