// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/depth_camera/depth_noise.hpp"

#include <vector>

namespace palpable::vision {

/// How a single depth map is freed from the noise of its camera. Defaults were chosen on generated rooms
/// (bench/depth_noise_set.cpp).
struct SmoothDepthOptions {
  /// How the noise grows with depth; its level is measured in each map (noise_level()).
  DepthNoise noise;
  /// Maps with a smaller level are exact, and remain as they are. 0 … 100.
  double least_level = 0.15;
  /// Above this level it is no camera's noise, and the map remains as it is. 0 … 100.
  double most_level = 3.0;
  /// Radii of the windows, each this many times the previous one, the first one 2. 1 … 8; 1.1 … 4.
  int windows = 4;
  double growth = 1.7;
  /// Readings that are farther from a plane than this many deviations do not belong to it. 1 … 10.
  double band = 3.0;
  /// A larger window is used where its depth is within this many deviations of the smaller window's. 0 … 10.
  double agreement = 3.0;
  /// A reading that fewer of its 24 neighbours share is a flying pixel. 0 … 24.
  int least_support = 5;
};

std::vector<Parameter> parameters_of(SmoothDepthOptions& options);

/// The noise of a depth map (metres, NaN = unknown) over that of the model: how far readings are from the
/// planes through small windows, where these are smoothest. 0 if too few pixels are known.
double noise_level(const Raster<float>& depth_m, const DepthNoise& noise);

struct SmoothDepth {
  Raster<float> depth_m;
  /// As noise_level(); 0 if the map was left as it was.
  double level = 0.0;
  std::size_t flying = 0;
};

/// Depth without the noise and the flying pixels of its camera; edges and details that exceed the noise stay.
/// Each pixel gets the depth of the plane through the readings on its surface (local linear regression, with
/// Tukey's weights) in the largest window that agrees with the smaller ones (intersection of confidence
/// intervals, Katkovnik 1999). A flying pixel takes the depth of the surface beside it that is nearer to its
/// own, or becomes unknown. Unknown pixels stay so. Long work: all threads, polls cancel. Errors: usage for
/// options out of range; interrupted.
Result<SmoothDepth> smooth_depth(const Raster<float>& depth_m, const SmoothDepthOptions& options,
                                 const Work& work);

}  // namespace palpable::vision
