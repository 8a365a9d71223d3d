// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <limits>
#include <optional>

namespace palpable {

/// A pinhole camera without distortion. Focal lengths and principal point in pixels; pixel centres are at
/// integers. fx, fy > 0.
struct Pinhole {
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  int width = 0;
  int height = 0;
  bool operator==(const Pinhole&) const = default;
};

/// A rectified stereo camera: depth Z = baseline_m * fx / (disparity + doffs_px), disparity = x_left -
/// x_right.
struct StereoRig {
  Pinhole left;
  double baseline_m = 0.0;
  /// Difference of the principal points in x, cx_right - cx_left, px: Middlebury's `doffs`.
  double doffs_px = 0.0;
  bool operator==(const StereoRig&) const = default;
};

/// The value of an unknown depth or disparity.
inline constexpr float kUnknownDepth = std::numeric_limits<float>::quiet_NaN();

/// Depth along the camera's z axis, metres; NaN = unknown. The camera is present if the source states it.
struct DepthMap {
  Raster<float> depth_m;
  std::optional<Pinhole> camera;
};

/// Disparity of the left picture, px: d = x_left - x_right, >= 0 for points in front of the cameras; NaN =
/// unknown.
struct DisparityMap {
  Raster<float> disparity_px;
  std::optional<StereoRig> rig;
};

/// Metric depth by the formula of StereoRig; pixels without positive Z become NaN. nullopt if the rig is
/// unknown.
std::optional<DepthMap> depth_from_disparity(const DisparityMap& disparity);

}  // namespace palpable
