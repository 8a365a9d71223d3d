// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/superquadric/superquadric_fit.hpp"
#include "palpable/sculpt/superquadric/superquadric_starts.hpp"

#include <limits>
#include <vector>

// Inside sculpt's sources only.
namespace palpable::sculpt {

/// Expectation and maximisation in turn (as Liu et al. 2022). A point is an inlier, near the surface with
/// Gaussian noise, or an outlier, anywhere in the evidence's box. The probability of being an inlier weights
/// it in a few steps of Levenberg-Marquardt on the radial distance, corrected to a Euclidean one to first
/// order.
class Refinement {
 public:
  Refinement(const Evidence& evidence, double volume, int count, const FitOptions& options);

  /// Ends early if the cost does not change any more, or would not fall below `to_beat` even if each further
  /// round gained more than the last one (FitSearchOptions::hoped_gain).
  void run(Candidate& c, int rounds, int steps, double to_beat = std::numeric_limits<double>::infinity());

  /// Whether the points are much farther from the candidate than can be of use.
  bool hopeless(const Candidate& c, const FitExpectation& expected);

  /// Share of inliers, and their mean distance.
  double inlier_share() const { return inliers_; }
  double error() const { return error_; }

 private:
  double area_seen(const Candidate& c) const;

  /// Estimates each point's probability of being an inlier, the noise, and the candidate's cost: minus the
  /// logarithm of the evidence's likelihood.
  void weigh(Candidate& c);

  void weigh_outline(const ResidualsAt& here, Candidate& c);

  /// A free place inside of the shape pulls the surface inwards, one outside has no weight.
  void weigh_free(const ResidualsAt& here, Candidate& c);

  /// A few steps of Levenberg-Marquardt with these weights.
  void improve(Candidate& c, int steps);

  const Evidence& evidence_;
  const FitOptions& options_;
  double volume_;
  int count_;
  Columns points_;
  Columns free_;
  Columns places_;  // the points, the points where lines of sight touch the shape, the free places
  std::vector<double> weights_;
  RadialDistances distances_;
  double inliers_ = 1.0;
  double error_ = 0.0;
};

}  // namespace palpable::sculpt
