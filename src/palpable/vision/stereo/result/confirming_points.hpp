// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo.hpp"

namespace palpable::vision {

/// What distinct points, matched over the whole pictures without any assumption about the cameras, say about
/// a dense match: it searched along rows only, so it finds something in any pair.
struct ConfirmingPoints {
  /// Points matched.
  int count = 0;
  /// Share of them that lie on the same row in both pictures, within the feature tolerance and a pixel. 0
  /// … 1.
  double on_rows = 0.0;
  /// Share of all points that lie on the same row and where the dense disparity is theirs within 2 px. 0 … 1.
  double confirmed = 0.0;
  /// From the 5th to the 95th percentile of the disparities of the confirmed points; px.
  double range_px = 0.0;
  /// Share of the confirmed points whose disparity is more than 1.5 px off the plane that fits most of them:
  /// near 0 where one homography explains the pair (a wall, or a camera that turned or zoomed without
  /// moving). 0 … 1.
  double off_plane = 0.0;
};

/// Compares SIFT matches of a rectified pair with its dense disparity (of the left picture; px).
/// Deterministic.
ConfirmingPoints confirming_points(const StereoPair& pair, const Raster<float>& disparity_px);

}  // namespace palpable::vision
