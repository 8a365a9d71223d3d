// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/image.hpp"

#include <optional>
#include <string>
#include <vector>

namespace palpable::vision {

/// Two pictures of the same size on common scanlines; the left one is the reference.
struct StereoPair {
  Image left;
  Image right;
  /// Known where the pair is calibrated; carried into the result.
  std::optional<StereoRig> rig;
};

/// The stereo methods of the papers, and ours (docs/stereo.md).
enum class StereoMethod { scanline, graph_cut, segments, pyramid, fast, best };

/// Where disparity steps: as correlation finds it, or moved to the picture's edges (Cochran & Medioni 1992).
enum class PyramidEdges { area, features };

/// What the method pyramid alone heeds.
struct PyramidOptions {
  /// Weight of a smooth surface against that of the picture, which lies between 0 and 1; > 0.
  float surface_weight = 0.5F;
  /// Rounds of the refinement; >= 0.
  int iterations = 20;
  PyramidEdges edges = PyramidEdges::area;
};

struct StereoOptions {
  /// Disparities 0 … max_disparity_px are searched; 0 = found automatically (find_disparity_range).
  int max_disparity_px = 0;
  PyramidOptions pyramid = {};
};

struct StereoMatch {
  /// Sub-pixel disparity of the left picture; NaN only where the method leaves pixels unknown.
  DisparityMap disparity;
  /// 0…1 per pixel; empty where the method gives none.
  Raster<float> confidence;
  /// What the person should know, a sentence each: swapped, misaligned, little agreement …
  std::vector<std::string> notes;
};

}  // namespace palpable::vision
