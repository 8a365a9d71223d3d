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

/// The stereo methods of the papers, and our own (docs/stereo.md); the options of each are in methods/.
enum class StereoMethod { scanline, graph_cut, segments, pyramid, fast, best };

struct StereoMatch {
  /// Sub-pixel disparity of the left picture; NaN only where the method leaves pixels unknown.
  DisparityMap disparity;
  /// 0…1 per pixel; empty where the method gives none.
  Raster<float> confidence;
  /// What the person should know, a sentence each: swapped, misaligned, little agreement …
  std::vector<std::string> notes;
};

}  // namespace palpable::vision
