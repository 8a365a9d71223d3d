// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <optional>

namespace palpable::vision {

struct PlaneTiltOptions {
  /// Shortest edge, share of the picture's diagonal. 0.001 … 0.5.
  double shortest_share = 0.005;
  /// Number of edges that are used, the longest ones. 10 … 20000.
  int most_edges = 4000;
  /// Two edges form a corner if ends of them are so close, in half diagonals. 0.001 … 0.2.
  double corner_reach = 0.015;
  /// Edges nearer to each other's direction than this form none, degrees. 1 … 45.
  double least_angle_deg = 20.0;
  /// Standard deviation of right angles, degrees, and their share of all corners. 0.1 … 20; 0.01 … 0.99.
  double deviation_deg = 4.0;
  double right_share = 0.35;
  /// Least gain of the corners' log-likelihood, natural logarithm, beside the picture as it is. 0 … 10000.
  /// Straight drawn maps gain up to 63 by chance (docs/history/2026-11-28-straight-maps.md).
  double least_gain = 80.0;
};
std::vector<Parameter> parameters_of(PlaneTiltOptions& options);

struct PlaneTilt {
  /// From a pixel to the plane seen from directly above, its scale and place undetermined, its commonest
  /// direction level.
  Matrix3 plane_from_pixel = kIdentity3;
  /// Of the corners' log-likelihood.
  double gain = 0.0;
};

/// How the plane that a picture shows is tilted, by the right angles that the picture gains when it is seen
/// from directly above: of corners of houses, letters, crossings, frames. A camera with square pixels, its
/// principal point in the picture's middle and focal lengths of 0.7 to 5 half diagonals is turned by up to
/// 50 degrees each way; the likelihood is that of a mixture of right angles and uniform ones (as Coughlan &
/// Yuille 1999 compare directions). nullopt where this is not clearly more likely than the picture as it is:
/// a straight picture, or one with too few corners. Errors: usage for options out of range; interrupted.
Result<std::optional<PlaneTilt>> find_plane_tilt(const Image& picture, const Work& work,
                                                 const PlaneTiltOptions& options = {});

}  // namespace palpable::vision
