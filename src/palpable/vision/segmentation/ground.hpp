// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/frame.hpp"
#include "palpable/core/image.hpp"
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
  /// 255 where the ground is seen, 0 elsewhere; as large as the picture.
  Raster<std::uint8_t> mask;
  /// Share of the picture, 0 … 1.
  double share = 0.0;
  /// Root mean square distance of the ground's pixels from the plane, pixels of disparity.
  double rms_px = 0.0;
};

/// How disparity was obtained. Matching carries it over edges and guesses what one camera does not see; a
/// depth sensor or renderer does neither.
enum class DisparityOrigin { matched, measured };

/// Finds the ground: a robust plane fit in disparity among planes that rise towards the bottom of the
/// picture, then the picture's regions (merge_regions) decide which pixels belong to it, and at its borders
/// their colours where disparity was matched. nullopt where no such plane holds enough of the picture. `left`
/// and `disparity_px` have the same size, and the options are in their ranges. Deterministic for a seed;
/// polls work.cancel (gives nullopt then).
std::optional<Ground> find_ground(const Raster<Rgb8>& left, const Raster<float>& disparity_px,
                                  const Work& work, DisparityOrigin origin = DisparityOrigin::matched,
                                  const GroundOptions& options = {});

/// The plane's unit normal in the left camera's frame, from the plane towards the camera.
Vector<CameraFrame> normal_of(const DisparityPlane& plane, const StereoRig& rig);

/// How the ground of a disparity map is treated.
enum class GroundTreatment {
  keep,
  /// The ground becomes the level base plate: disparities are measured from its plane, the ground's own are
  /// 0.
  flatten,
  /// The ground and what seems to lie under it are lowered to the level of the farthest object that is left.
  remove
};

/// The name on the command line; and back, nullopt for an unknown name.
std::string_view name_of(GroundTreatment treatment);
std::optional<GroundTreatment> ground_treatment_from(std::string_view name);

/// The map with its ground treated. Flattened disparities belong to no rig (they are heights above the
/// ground, as parallax), so the rig is dropped.
DisparityMap treat_ground(const DisparityMap& disparity, const Ground& ground, GroundTreatment treatment);

}  // namespace palpable::vision
