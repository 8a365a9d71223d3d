// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/level_set.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/points/fused_distances.hpp"
#include "palpable/sculpt/relief/occupancy_from_depth.hpp"

#include <limits>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// What voxels become that no map saw and that are not behind a surface as FusionOptions::fill_share says.
enum class Unseen {
  empty,
  /// Solid below a surface, down to the next voxel that a map saw to be empty: what stands on a ground has no
  /// caves that nobody saw. Up is z of the scene.
  solid_below_surfaces
};

/// How depth maps are fused. Chosen on balls seen by simulated cameras with noise.
struct FusionOptions {
  /// Voxels along the longest side of the seen volume. 16 … 512.
  int resolution = 256;
  /// Depths outside this range are ignored, metres.
  double near_m = 0.0;
  double far_m = std::numeric_limits<double>::infinity();
  /// Truncation of distances, voxels along a line of sight. 1 … 64.
  double truncation_voxels = 4.0;
  /// Depth behind a surface that is filled although fewer than half of the maps saw it, share of the longest
  /// side. 0 … 1.
  double fill_share = 0.05;
  Unseen unseen = Unseen::empty;
  /// With solid_below_surfaces only: a voxel is behind a map's surface, but for fill_share, where the line of
  /// sight falls by at least this much per horizontal length, so the filled shadow of what stands on the
  /// ground is at most 1 / least_fall times as long as high. Level lines of sight would fill a room behind
  /// its furniture. 0 … 100; 0 = in every direction.
  double least_fall = 0.5;
  /// The smoothing of the remaining noise.
  SmoothingOptions smoothing = {};
};

/// Without the range of depths and what is unseen, which depend on the input.
std::vector<Parameter> parameters_of(FusionOptions& options);

/// Fuses several depth maps into one solid (Curless & Levoy 1996). A voxel's value is the mean of the
/// truncated signed distances along the lines of sight, over all maps that saw the voxel or its surface. A
/// voxel that no map saw is solid if it lies behind the surface of more than half of the maps (see least_fall
/// too), or at most fill_share behind that of one (Park & Howard 2012 fill in the same way); otherwise
/// `unseen` decides. Pixels at depth discontinuities are ignored. The remaining noise is smoothed (smooth()),
/// which keeps edges larger than the noise. The level set holds truncated distances in metres. Long work: all
/// threads, polls cancel. Errors: usage for options out of range; invalid_input for a map without its camera,
/// of another size than it, or maps without a depth in range; interrupted.
Result<LevelSet> fused_depth(std::span<const DepthView> views, const FusionOptions& options,
                             const Work& work);

}  // namespace palpable::sculpt
