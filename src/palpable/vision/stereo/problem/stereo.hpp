// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/vision/stereo/problem/epipolar_frame.hpp"

#include <optional>
#include <string>
#include <vector>

namespace palpable::vision {

/// Two pictures of the same size; the left one is the reference. They are rectified, or `frame` says how
/// their points come to common rows.
struct StereoPair {
  Image left;
  Image right;
  /// Known if the pair is calibrated; copied to the result.
  std::optional<StereoRig> rig;
  /// Of pictures that are as they were taken, of a camera that was not moved straight to the side.
  std::optional<EpipolarFrame> frame = {};
};

struct StereoMatch {
  /// Sub-pixel disparity of the left picture; NaN where the method leaves pixels unknown.
  DisparityMap disparity;
  /// The share of such disparities that is right within 1 px on rendered scenes (confidence.hpp), 0…1; 0
  /// where it is unknown.
  Raster<float> confidence;
  /// 1 where both views agree within a pixel, else 0; empty if the method has one view only.
  Raster<float> confirmed;
  /// Sentences for the user: exchanged, misaligned, little agreement …
  std::vector<std::string> notes;
  /// Left and right were exchanged: the disparity still belongs to the first picture, but the other picture
  /// shows a pixel that much farther right.
  bool exchanged = false;
};

}  // namespace palpable::vision
