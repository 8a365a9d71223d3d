// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/level_set.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/relief/occupancy_from_depth.hpp"

#include <limits>
#include <span>

namespace palpable::sculpt {

struct FusionOptions {
  /// Voxels along the longest side of what the views saw, 16 ... 512.
  int resolution = 256;
  /// Depths nearer or farther than this do not count, metres.
  double near_m = 0.0;
  double far_m = std::numeric_limits<double>::infinity();
  /// Distances are truncated beyond so many voxels along a line of sight.
  double truncation_voxels = 4.0;
  /// Of the longest side: how far behind a surface that few maps saw it is solid.
  double fill_share = 0.05;
  /// How much a voxel's distance errs by the maps' noise before it is smoothed, metres; 0: as the maps
  /// themselves disagree about it.
  double noise_m = 0.0;
};

/// Several depth maps as one solid (Curless & Levoy 1996): at each voxel the mean of the signed distances
/// along the lines of sight, truncated, of all maps that saw the voxel or its surface. What none of them saw
/// is solid, as Park & Howard 2012 fill behind, where it lies behind a surface for more than half of the
/// maps, or for one of them no deeper than fill_share; all else is empty. Pixels at steps of depth do not
/// count. What the noise leaves uneven is smoothed: a number that is beside the mean of its neighbours goes
/// there as far as the noise explains it, so edges that stand out of the noise stay. The level set's numbers
/// are truncated distances in metres. Long work: all threads, polls cancel. Errors: usage for options out of
/// range; invalid_input for a map without its camera, of another size than it, or maps in which no depth
/// counts; interrupted.
Result<LevelSet> fused_depth(std::span<const DepthView> views, const FusionOptions& options,
                             const Work& work);

}  // namespace palpable::sculpt
