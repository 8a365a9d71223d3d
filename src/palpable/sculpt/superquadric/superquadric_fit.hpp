// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/sculpt/superquadric/superquadric_options.hpp"
#include "palpable/sculpt/superquadric/superquadric_residuals.hpp"

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// What a picture adds to its points: the position of the camera, and the solid's outline.
struct FitView {
  Point<SceneFrame> eye;
  /// Lines of sight that touch the solid; may be empty.
  std::vector<LineOfSight> outline;
};

struct FittedSuperquadric {
  models::Superquadric shape;
  /// Standard deviation of the points that belong to the shape, and their share of all.
  double noise_m = 0.0;
  double inlier_share = 1.0;
  /// Mean distance of those points to the surface, to first order.
  double error_m = 0.0;
};

/// What a caller knows before a fit.
struct FitExpectation {
  /// A shape near which the fit is looked for, instead of everywhere, in less time; a plain one is
  /// deformed as the options allow.
  std::optional<models::Superquadric> start = {};
  /// A shape with a greater root mean square distance of the points, each at most `truncated_m`, is of no
  /// use: a search that is much farther (FitSearchOptions::hopeless_deviation) ends with what it has.
  double most_deviation_m = std::numeric_limits<double>::infinity();
  double truncated_m = std::numeric_limits<double>::infinity();
};

/// Fits one superquadric to points of a surface (the scene's frame, metres): of all around, or of one side
/// with its `view`. `free_m`: places known to be empty, which must not lie inside of the shape. At least 12
/// points, finite, not all on one plane or line (a plane has no volume). FitMethod::solina uses neither free
/// places nor what is expected. Errors: usage for options out of range, invalid_input.
Result<FittedSuperquadric> fit_superquadric(std::span<const Vec3> points_m,
                                            const std::optional<FitView>& view,
                                            const FitOptions& options = {}, std::span<const Vec3> free_m = {},
                                            const FitExpectation& expected = {});

}  // namespace palpable::sculpt
