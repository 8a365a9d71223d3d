// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/recipes/solid/correction_reach.hpp"
#include "palpable/sculpt/correction/surface_correction.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/superquadric/superquadric_set.hpp"

#include <vector>

namespace palpable::recipes {

/// How superquadrics are fitted to a solid's surface, and then corrected by it (Moustakas et al. 2007).
struct PredictionOptions {
  /// Samples along the solid's longest side, of the surface that is measured and of the one that is
  /// predicted. 32 … 1024.
  int samples = 200;
  /// Points that errors are measured at, at most. 100 … 1 000 000.
  int error_points = 3000;
  /// Further shapes are fitted to points farther than this share of the longest side from all shapes, 0.001 …
  /// 0.5, if they are at least this share of all points, 0 … 1.
  double rest_share = 0.015;
  double least_rest = 0.01;
  /// Balls fill what no shape covers within the solid: places of a lattice with so many along the longest
  /// side, 4 … 64, that are farther than this share of it from the surface and from all shapes, 0.001 … 0.5.
  int inner_places = 32;
  double least_inner = 0.03;
  /// Most passes of the correction, 0 … 20; a pass that lowers the error by less than this share is the last,
  /// 0 … 1.
  int passes = 3;
  double least_gain = 0.02;
  /// Shapes are at least so many spacings of samples thick where their surface is sampled, 1 … 10.
  double least_thickness_spacings = 3.0;
  CorrectionReachOptions reach;
  /// reach_m and transition_m are not used: they follow from `reach`.
  sculpt::CorrectionOptions correction{.most_match_angle_deg = 60.0, .most_turn_deg = 75.0};
  /// The correction does the rest, so that shapes need not be as close as those that stand alone; but they
  /// must keep within the solid's silhouettes, since what reaches out of reach stays.
  sculpt::ShapeSetOptions shapes{.tolerance_share = 0.03, .most_beyond = 0.004, .free_tolerances = 0.15};
};
std::vector<Parameter> parameters_of(PredictionOptions& options);

/// The superquadrics of a solid and their correction, in the solid's frame.
struct PredictedSolid {
  std::vector<models::Superquadric> shapes;
  /// The corrected surface, closed, facing outwards; it may fold. Empty if `shapes` are closer to the solid.
  Mesh surface;
  /// Spacing of the corrected surface's samples, metres.
  double spacing_m = 0.0;
  /// Mean distance of the solid's surface from the shapes' and from the corrected one, metres.
  double predicted_error_m = 0.0, corrected_error_m = 0.0;
};

/// The surface of a solid as a closed mesh, facing outwards, with `samples` > 0 along its longest side
/// (sculpt::dual_contour()). Errors: invalid_input for a solid that is thinner everywhere; interrupted.
Result<Mesh> sampled_surface(const sculpt::DistanceSource& solid, int samples, const Work& work);

/// Fits superquadrics to points all over the surface of `solid` (sculpt::fit_superquadrics()), fills with
/// balls what they leave hollow (slabs of flat parts), and corrects their closed surface by the solid's in
/// several passes, of which each lowers the error. Deterministic. Long work, any thread. Errors: usage for
/// options out of range; invalid_input for a solid to which no shape fits; as dual_contour() and
/// correct_surface().
Result<PredictedSolid> predicted_solid(const sculpt::DistanceSource& solid, const PredictionOptions& options,
                                       const Work& work);

}  // namespace palpable::recipes
