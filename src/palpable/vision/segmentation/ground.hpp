// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/segmentation/disparity_plane.hpp"
#include "palpable/vision/segmentation/ground_options.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace palpable::vision {

/// The plane that objects stand on (Park & Howard 2012, 4.1).
struct Ground {
  DisparityPlane plane;
  /// 255 on visible ground, 0 elsewhere; as large as the picture.
  Raster<std::uint8_t> mask;
  /// Share of the picture, 0 … 1.
  double share = 0.0;
  /// Root mean square distance of the ground's pixels from the plane, pixels of disparity.
  double rms_px = 0.0;
};

/// How disparity was obtained. Matching extends it over edges and guesses it in occlusions; a depth sensor or
/// renderer does neither.
enum class DisparityOrigin { matched, measured };

/// Finds the ground: a robust fit of a disparity plane that rises towards the bottom of the picture. Then
/// colour regions (merge_regions) decide which pixels belong to it, and colour decides at its borders if
/// disparity was matched. nullopt if no such plane covers enough of the picture. `left` and `disparity_px`
/// have the same size, and the options are in their ranges. Deterministic for a seed; polls work.cancel
/// (gives nullopt then).
std::optional<Ground> find_ground(const Raster<Rgb8>& left, const Raster<float>& disparity_px,
                                  const Work& work, DisparityOrigin origin = DisparityOrigin::matched,
                                  const GroundOptions& options = {});

/// The plane's unit normal in the left camera's frame, from the plane towards the camera.
Vector<CameraFrame> normal_of(const DisparityPlane& plane, const StereoRig& rig);

/// How the ground of a disparity map is treated.
enum class GroundTreatment {
  keep,
  /// The ground becomes the flat base plate: disparities are measured from its plane, and those of the ground
  /// are 0.
  flatten,
  /// The ground and everything that seems to be under it are lowered to the level of the farthest remaining
  /// object.
  remove
};

/// The name on the command line; and back, nullopt for an unknown name.
std::string_view name_of(GroundTreatment treatment);
std::optional<GroundTreatment> ground_treatment_from(std::string_view name);

/// The map with its ground treated. Flattened disparities belong to no rig (they are heights above the
/// ground, as parallax), so the rig is dropped.
DisparityMap treat_ground(const DisparityMap& disparity, const Ground& ground, GroundTreatment treatment);

}  // namespace palpable::vision
