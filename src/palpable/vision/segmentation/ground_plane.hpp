// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/segmentation/ground.hpp"

#include <optional>

namespace palpable::vision {

/// A plane of disparity that could be the ground, and how closely the pixels near it keep to it.
struct GroundPlane {
  DisparityPlane plane;
  /// Standard deviation of the inliers, robustly.
  double sigma_px = 0.0;
};

/// The best supported plane that rises towards the bottom of the picture and holds at least a twentieth of
/// what is known, over more of a rise than noise explains; it must still do so when it is fitted to all that
/// lies near it. nullopt where there is none, or Work is cancelled. Deterministic for a seed.
std::optional<GroundPlane> find_ground_plane(const Raster<float>& disparity_px, const Work& work);

}  // namespace palpable::vision
