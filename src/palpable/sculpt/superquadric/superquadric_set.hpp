// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/superquadric/superquadric_fit.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace palpable::sculpt {

struct ShapeSetOptions {
  /// Mean distance of a shape's points to it that is good enough, metres; 0 = a hundredth of the points' box
  /// diagonal, or three times their noise if that is more.
  double tolerance_m = 0.0;
  /// 1 ... 256.
  int most_shapes = 24;
  /// A point that lies farther from a shape than this many tolerances counts no more than that. 1 ... 100.
  double most_tolerances = 4.0;
  /// A part is cut into two so often at most. 1 ... 12.
  int most_cuts = 6;
  /// A part of whose points this share lies on one plane is cut into the plane and what stands on it. > 0
  /// ... 1.
  double least_plane_share = 0.3;
};
/// Defaults chosen on superquadrics that were seen from one side, with noise of 1 % (superquadric_cases.hpp).
std::vector<Parameter> parameters_of(ShapeSetOptions& options);

struct ShapeSet {
  /// The largest share of the points first.
  std::vector<FittedSuperquadric> shapes;
  /// The tolerance that was used, the mean distance of all points to the shape that they belong to (at most
  /// four times the tolerance each), and the share of the points that belong to none.
  double tolerance_m = 0.0;
  double error_m = 0.0;
  double left_out = 0.0;
};

/// Several superquadrics for one scene's points (metres): cut into parts until each part fits a shape, then
/// adjacent parts joined while one shape fits both (split and merge), points given to their nearest
/// shape and fitted again. What lies on a plane becomes a slab, as thick as 2 % of its length, behind the
/// plane as seen from the eye, or around it. `eye`: from where all points were seen (a depth map), else they
/// are of all around. `labels`: empty, or one for each point; points of different labels never share a shape.
/// Deterministic. At least 12 points, finite. Long work: reports progress, polls cancel. Errors: usage for
/// options out of range; invalid_input; interrupted.
Result<ShapeSet> fit_superquadrics(std::span<const Vec3> points_m, std::span<const std::uint8_t> labels,
                                   const std::optional<Point<SceneFrame>>& eye,
                                   const ShapeSetOptions& options, const Work& work);

}  // namespace palpable::sculpt
