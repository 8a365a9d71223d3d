// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/vision/rectification/feature_matches.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <vector>

namespace palpable::vision {

/// How distinct points are compared with a dense match.
struct ConfirmingOptions {
  /// A point lies on the same row in both pictures within the feature tolerance and this. 0 … 20 px.
  double row_px = 1.0;
  /// The dense disparity agrees with a point's within this. 0 … 20 px.
  double agree_px = 2.0;
  /// A point lies on the dominant plane within this. 0 … 20 px.
  double on_plane_px = 1.5;
};

std::vector<Parameter> parameters_of(ConfirmingOptions& options);

/// Evidence for a dense match from distinct points, which are matched over the whole pictures without any
/// assumption about the cameras. A dense match searches along rows only, so it finds matches in any pair.
struct ConfirmingPoints {
  /// Points matched.
  int count = 0;
  /// Share of them that lie on the same row in both pictures. 0 … 1.
  double on_rows = 0.0;
  /// Share of all points that lie on the same row and agree with the dense disparity. 0 … 1.
  double confirmed = 0.0;
  /// From the 5th to the 95th percentile of the disparities of the confirmed points; px.
  double range_px = 0.0;
  /// Share of the confirmed points off the plane of disparity that fits most of them: near 0 if one
  /// homography explains the pair (a wall, or a camera that was rotated or zoomed without moving). 0 … 1.
  double off_plane = 0.0;
  /// Whether one rigid motion explains the points; only then the following is known.
  bool rigid = false;
  /// Share of the explained points that a camera which only turned and zoomed does not explain. 0 … 1.
  double beyond_turn = 0.0;
  /// How surely the motion says which point is nearer, as PairMotion::certainty. -1 … 1.
  double certainty = 0.0;
  /// How far the dense disparities at the explained points agree with the points' own inverse depths on which
  /// of two points is nearer (Goodman and Kruskal's gamma). -1 … 1.
  double depth_order = 0.0;
};

/// Compares SIFT matches of a rectified pair with its dense disparity (of the left picture; px).
/// Deterministic.
ConfirmingPoints confirming_points(const StereoPair& pair, const Raster<float>& disparity_px,
                                   const ConfirmingOptions& options = {});

/// The share of matches off the plane of disparity that fits most of them, as ConfirmingPoints::off_plane; 0
/// for fewer than four.
double share_off_plane(const std::vector<FeatureMatch>& matches, double on_plane_px);

}  // namespace palpable::vision
