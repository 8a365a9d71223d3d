// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/superquadric/free_space.hpp"
#include "palpable/sculpt/superquadric/slab_fit.hpp"
#include "palpable/sculpt/superquadric/superquadric_fit.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// How points are divided among shapes. Defaults were chosen on generated figures, unions of superquadrics
/// seen from one side and from all sides (bench/primitive_set.cpp).
struct ShapeSetOptions {
  /// Distance of a shape's points to it that is good enough, metres; 0 = tolerance_share of the diagonal of
  /// the points' box, or tolerance_noises times their noise if that is more. 0 … 1000 m; 0 … 1; 0 … 100.
  double tolerance_m = 0.0;
  double tolerance_share = 0.01;
  double tolerance_noises = 3.0;
  /// By the information criterion, distances below this share of the tolerance are not worth a parameter, and
  /// more points than this count as so many observations, since neighbours have the same misfit. 0.01 … 1; 12
  /// … 1e6.
  double resolution_share = 0.25;
  int most_observations = 750;
  /// 1 … 256.
  int most_shapes = 24;
  /// The distance of a point to a shape is truncated at this many tolerances. 1 … 100.
  double most_tolerances = 4.0;
  /// Greatest number of successive cuts of a part. 1 … 12.
  int most_cuts = 6;
  /// A part with this share of its points on one plane is cut along the plane. 0.01 … 1.
  double least_plane_share = 0.3;
  /// Parts with fewer points are not cut. 12 … 1e6.
  int least_cut_points = 96;
  /// Points within this many mean spacings are connected, and their parts adjacent. 0.5 … 20.
  double gap_spacings = 2.0;
  /// A shape may be this many times as long as its points; along the line of sight, where its far side is
  /// hidden, it may be longer by this multiple of its points' greatest distance from the line. 1 … 10; 0 …
  /// 100.
  double most_length = 1.3;
  double most_hidden_length = 3.0;
  /// Greatest share of a shape's surface in free space. Space is free in front of the points by more than
  /// this many tolerances. 0.001 … 1; 0 … 100.
  double most_beyond = 0.02;
  double free_tolerances = 0.5;
  /// Free places around a part that its shape must avoid, and their greatest distance from the part over the
  /// diagonal of its box. 1 … 1e5; 0.01 … 10.
  int free_places = 200;
  double free_reach = 0.5;
  /// Rounds of joining parts and assigning points to their nearest shape. 0 … 100.
  int rounds = 1;
  /// Two parts as one are fitted near the shape of that which holds at least this share of their points.
  double near_share = 0.9;
  /// Numbers of points that are used at most: of all; of a part, to fit a shape; and to measure its error.
  /// 12 … 1e6 each.
  int used_points = 6000;
  int fitted_points = 400;
  int measured_points = 250;
  SlabOptions slab = {};
  FreeSpaceOptions space = {};
  /// The fit of one shape. A shape is tapered or bent, as the deformation allows, only where the criterion
  /// falls.
  FitOptions fit = {FitMethod::robust, FitDeformation::taper_and_bend, {}, {}, {}};
};

/// All parameters of the set, its slabs and its fits.
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

/// Fits several superquadrics to one scene's points (metres) by split and merge. Points are cut into parts
/// until each part fits a shape. Then adjacent parts are joined while the Bayesian information criterion
/// falls, points are assigned to their nearest shape, and shapes are fitted again. A flat part becomes a slab
/// behind its plane as seen from the eye, or around the plane without an eye. No shape reaches into free
/// space (FreeSpace) with more than options.most_beyond of its surface. `eye`: the position from which all
/// points were seen (a depth map); not set if they were seen from all sides. `labels`: empty, or one for each
/// point; points of different labels never share a shape. Deterministic. At least 12 points, finite. Long
/// work: all threads, reports progress, polls cancel. Errors: usage for options out of range; invalid_input;
/// interrupted.
Result<ShapeSet> fit_superquadrics(std::span<const Vec3> points_m, std::span<const std::uint8_t> labels,
                                   const std::optional<Point<SceneFrame>>& eye,
                                   const ShapeSetOptions& options, const Work& work);

}  // namespace palpable::sculpt
