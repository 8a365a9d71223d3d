// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"

#include <limits>
#include <optional>

namespace palpable {

/// A pinhole camera without distortion. Pixels, pixel centres at integers. fx, fy > 0.
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
  /// x-difference of the principal points, cx_right - cx_left, as Middlebury's `doffs`.
  double doffs_px = 0.0;
  bool operator==(const StereoRig&) const = default;
};

/// The value of a depth or disparity that is not known.
inline constexpr float kUnknownDepth = std::numeric_limits<float>::quiet_NaN();

/// Depth along the camera's z axis in metres (float), NaN = unknown. The camera is known where the source
/// stated it.
struct DepthMap {
  Raster<float> depth_m;
  std::optional<Pinhole> camera;
};

/// Disparity of the left picture in pixels, d = x_left - x_right >= 0 for points in front, NaN = unknown.
struct DisparityMap {
  Raster<float> disparity_px;
  std::optional<StereoRig> rig;
};

/// Metric depth where the rig is known (its formula above); pixels without positive Z become NaN.
/// Without a rig: nullopt.
std::optional<DepthMap> depth_from_disparity(const DisparityMap& disparity);

}  // namespace palpable
