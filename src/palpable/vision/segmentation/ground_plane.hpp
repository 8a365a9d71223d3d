// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/segmentation/disparity_plane.hpp"
#include "palpable/vision/segmentation/ground_options.hpp"

#include <optional>

namespace palpable::vision {

/// A plane of disparity that could be the ground.
struct GroundPlane {
  DisparityPlane plane;
  /// Robust standard deviation of its inliers.
  double sigma_px = 0.0;
};

/// The planes to search: possible grounds, or planes of any orientation.
enum class PlaneDirection { ground, any };

/// The best supported plane that rises towards the bottom of the picture, with enough of the known pixels and
/// a larger rise than noise explains, also after fitting it to all pixels near it. nullopt if there is none
/// or the work is cancelled. Deterministic for a seed.
std::optional<GroundPlane> find_ground_plane(const Raster<float>& disparity_px, const Work& work,
                                             const GroundPlaneOptions& options = {});

/// The best supported plane of any orientation with little behind it: pixels behind it count against it by
/// `under_penalty`. Otherwise like find_ground_plane().
std::optional<GroundPlane> find_back_plane(const Raster<float>& disparity_px, const Work& work,
                                           const GroundPlaneOptions& options = {});

}  // namespace palpable::vision
