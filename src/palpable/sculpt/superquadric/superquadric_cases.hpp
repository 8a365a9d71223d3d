// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/superquadric.hpp"
#include "palpable/sculpt/superquadric/superquadric_fit.hpp"

#include <optional>
#include <vector>

namespace palpable::sculpt {

/// Sampled points of a random shape with its true parameters, for measuring fits. Lengths are about 1, in
/// any unit.
struct FitCase {
  models::Superquadric truth;
  std::vector<Vec3> points;
  /// Of a half view only: the eye, and the outline from a picture of 128 x 128 pixels.
  std::optional<FitView> view;
};

struct FitCaseOptions {
  /// Points of the surface; outliers are added, so that they are this share of all points.
  int points = 800;
  double noise = 0.01;
  double outlier_share = 0.0;
  /// Points from all sides, or those seen by one eye 6 units away.
  enum class Seen { whole, half } seen = Seen::whole;
  FitDeformation deformation = FitDeformation::none;
};

/// Half axes 0.5 ... 1.5, exponents 0.1 ... 1, any rotation, centre within a unit; points evenly by area with
/// Gaussian noise, outliers even in the shape's box doubled. Deterministic by `seed`.
FitCase make_fit_case(unsigned seed, const FitCaseOptions& options);

/// Mean distance, along rays from the fitted shape's centre, of points spread over the true surface to the
/// fitted one.
double mean_radial_error(const models::Superquadric& fitted, const models::Superquadric& truth);

}  // namespace palpable::sculpt
