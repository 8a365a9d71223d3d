// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/superquadric.hpp"
#include "palpable/sculpt/superquadric/superquadric_options.hpp"
#include "palpable/sculpt/superquadric/superquadric_residuals.hpp"

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// The input of a fit, normalised: its middle is 0 and its scale 1.
struct Evidence {
  std::vector<Vec3> points;
  std::vector<LineOfSight> outline;
  /// Places outside of the solid.
  std::vector<Vec3> free;
  std::optional<Vec3> eye;
};

/// A candidate of the search: the shape, and how the evidence is weighted.
struct Candidate {
  models::Superquadric shape;
  double noise = 0.0;
  double sight_noise = 0.0;
  double outliers = 0.1;
  double cost = std::numeric_limits<double>::infinity();
};

/// The median of at least one number; of places, along each axis by itself.
double median_of(std::vector<double> values);
Vec3 median_of(std::span<const Vec3> points);

/// The starts of the search: each of the principal axes as the shape's z, also rotated by 45 degrees about
/// it, since a compact body determines neither.
std::vector<Candidate> starts_for(const Evidence& evidence, const FitStartOptions& options);

/// Parameters that give nearly the same shape but lie at another local minimum: every axis as z, and the
/// square section turned by 45 degrees with its dual exponent.
std::vector<Candidate> switched(const Candidate& c, const FitStartOptions& options);

/// Starts for a deformed body from a plain shape: each of its axes as z, plain, and tapered or bent either
/// way, as `parameters` (kTaperParameters or kBendParameters) allows.
std::vector<Candidate> deformed(const Candidate& c, int parameters, const FitStartOptions& options);

/// The papers' start: axes and sizes from the second moments, the axis of the most different one as z.
models::Superquadric start_from_moments(std::span<const Vec3> points);

}  // namespace palpable::sculpt
