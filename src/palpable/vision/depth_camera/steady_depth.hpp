// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/vision/depth_camera/depth_noise.hpp"

namespace palpable::vision {

struct SteadyDepthOptions {
  DepthNoise noise;
  /// A surface at rest becomes the mean of its readings, in which a new one weighs at least 1 over this
  /// number of frames; 1 ... 1000.
  int frames = 8;
  /// For this time a pixel without a reading keeps its last depth; 0 ... 60.
  double hold_s = 0.5;
};

/// Depth that does not tremble between the frames of a camera at rest. Where a reading is on the surface of
/// the mean so far, both are averaged; where it is not, something moved, and it takes the mean's place at
/// once. Where the readings around it have moved together by more than noise, the mean moves with them first,
/// so that a surface that moves slowly is not seen late. One thread.
class SteadyDepth {
 public:
  /// `options` within their ranges (check()).
  explicit SteadyDepth(const SteadyDepthOptions& options) : options_(options) {}

  /// The depth after one more frame, of clean_depth(), which came `dt_s` >= 0 after the previous one. A frame
  /// of another size begins anew. The reference is valid until the next call.
  const Raster<float>& add(const Raster<float>& depth_m, double dt_s);

 private:
  /// How far the surface at each pixel has moved since the last frame, as far as that is more than noise.
  Raster<float> movements_m(const Raster<float>& depth_m) const;
  float movement_m(const Raster<float>& depth_m, int x, int y, float change_m, float deviation_m) const;

  SteadyDepthOptions options_;
  Raster<float> mean_m_;
  /// The number of readings in a mean, at most options_.frames; and the time since the last one.
  Raster<float> weight_;
  Raster<float> age_s_;
};

/// Errors: usage for a value outside its range.
Result<void> check(const SteadyDepthOptions& options);

}  // namespace palpable::vision
