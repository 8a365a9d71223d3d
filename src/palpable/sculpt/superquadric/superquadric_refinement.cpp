// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_refinement.hpp"

#include "palpable/sculpt/superquadric/weighted_residuals.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <ceres/tiny_solver.h>

namespace palpable::sculpt {
namespace {

using models::Superquadric;
using Matrix = std::array<double, 9>;

constexpr double kRoot2Pi = 2.50662827463100050;

/// Roughly the surface's area: that of a box, less its corners.
double area_of(const Superquadric& s) {
  return 6.0 * (s.size_m.x * s.size_m.y + s.size_m.y * s.size_m.z + s.size_m.z * s.size_m.x);
}

}  // namespace

Refinement::Refinement(const Evidence& evidence, double volume, int count, const FitOptions& options)
    : evidence_(evidence),
      options_(options),
      volume_(volume),
      count_(count),
      points_(evidence.points.size()),
      free_(evidence.free.size()),
      places_(evidence.points.size() + evidence.outline.size() + evidence.free.size()),
      weights_(places_.count()) {
  for (std::size_t i = 0; i < evidence.points.size(); ++i) {
    points_.set(i, evidence.points[i]);
    places_.set(i, evidence.points[i]);
  }
  for (std::size_t i = 0; i < evidence.free.size(); ++i) {
    free_.set(i, evidence.free[i]);
    places_.set(evidence.points.size() + evidence.outline.size() + i, evidence.free[i]);
  }
}

double Refinement::area_seen(const Candidate& c) const {
  return (evidence_.eye ? 0.5 : 1.0) * area_of(c.shape);
}

void Refinement::run(Candidate& c, int rounds, int steps, double to_beat) {
  const FitSearchOptions& search = options_.search;
  double noise = 0.0;
  double cost = std::numeric_limits<double>::infinity();
  for (int k = 0; k < rounds; ++k) {
    noise = c.noise;
    weigh(c);
    const bool settled = c.noise > (1.0 - search.settled_noise) * noise &&
                         cost - c.cost < search.settled_cost * static_cast<double>(points_.count());
    if (k > 0 && settled) return;
    if (k >= search.hopeless_after &&
        c.cost - to_beat > search.hoped_gain * (rounds - k) * std::max(cost - c.cost, 0.0))
      return;
    cost = c.cost;
    improve(c, steps);
  }
  weigh(c);
}

bool Refinement::hopeless(const Candidate& c, const FitExpectation& expected) {
  if (!std::isfinite(expected.most_deviation_m)) return false;
  Matrix reference;
  const Parameters parameters = parameters_of(c.shape, reference);
  ResidualsAt(parameters, reference, count_).radial_distances_of(points_, distances_);
  double squares = 0.0;
  for (std::size_t i = 0; i < points_.count(); ++i) {
    const double r =
        std::min(std::abs(distances_.euclidean_share[i] * distances_.radial[i]), expected.truncated_m);
    squares += r * r;
  }
  return std::sqrt(squares / static_cast<double>(points_.count())) >
         options_.search.hopeless_deviation * expected.most_deviation_m;
}

void Refinement::weigh(Candidate& c) {
  Matrix reference;
  const Parameters parameters = parameters_of(c.shape, reference);
  const ResidualsAt here(parameters, reference, count_);
  const double inlier = (1.0 - c.outliers) / (kRoot2Pi * c.noise * area_seen(c));
  const double ratio = c.outliers / volume_ / inlier;
  const double narrow = -0.5 / (c.noise * c.noise);
  const FitWeightOptions& weights = options_.weights;
  double sum = 0.0;
  double squares = 0.0;
  double lengths = 0.0;
  const auto all = static_cast<double>(points_.count());
  c.cost = -all * std::log(inlier);
  here.radial_distances_of(points_, distances_);
  for (std::size_t i = 0; i < points_.count(); ++i) {
    const double r = distances_.euclidean_share[i] * distances_.radial[i];
    // A point on the hidden side is not a point of this shape.
    const bool seen = !evidence_.eye || here.faces(points_.at(i), distances_.outward.at(i), *evidence_.eye);
    const double near = seen ? std::exp(narrow * r * r) : 0.0;
    const double belief = near / (near + ratio);
    c.cost -= std::log(near + ratio);
    weights_[i] = std::sqrt(belief) * distances_.euclidean_share[i];
    sum += belief;
    squares += belief * r * r;
    lengths += belief * std::abs(r);
  }
  if (sum > weights.least_inlier_share * all) {
    // Coarse noise is mostly misfit, which must not become weight: it is reduced in each round.
    const double most = c.noise > weights.coarse_noise ? weights.coarse_noise_factor * c.noise : c.noise;
    c.noise = std::clamp(std::sqrt(squares / sum), std::min(weights.least_noise, most), most);
    c.outliers = std::clamp(1.0 - sum / all, weights.least_outliers, weights.most_outliers);
    error_ = lengths / sum;
  }
  inliers_ = sum / all;
  for (std::size_t i = 0; i < points_.count(); ++i) weights_[i] /= c.noise;
  if (!evidence_.outline.empty()) weigh_outline(here, c);
  if (!evidence_.free.empty()) weigh_free(here, c);
}

void Refinement::weigh_outline(const ResidualsAt& here, Candidate& c) {
  const Columns grazes = here.nearest_on(evidence_.outline);
  here.radial_distances_of(grazes, distances_);
  double sum = 0.0;
  double squares = 0.0;
  const double narrow = -0.5 / (c.sight_noise * c.sight_noise);
  const std::size_t first = points_.count();
  for (std::size_t i = 0; i < grazes.count(); ++i) {
    const double r = distances_.euclidean_share[i] * distances_.radial[i];
    const double near = std::exp(narrow * r * r);
    const double belief = near / (near + options_.weights.stray_sights);
    c.cost -= std::log((near + options_.weights.stray_sights_cost) / c.sight_noise);
    sum += belief;
    squares += belief * r * r;
    places_.set(first + i, grazes.at(i));
    weights_[first + i] = std::sqrt(belief) * distances_.euclidean_share[i];
  }
  if (sum > 0.1 * static_cast<double>(grazes.count()))
    c.sight_noise = std::clamp(std::sqrt(squares / sum),
                               std::min(options_.weights.least_noise, c.sight_noise), c.sight_noise);
  for (std::size_t i = first; i < first + grazes.count(); ++i) weights_[i] /= c.sight_noise;
}

void Refinement::weigh_free(const ResidualsAt& here, Candidate& c) {
  here.radial_distances_of(free_, distances_);
  const double noise = std::max(c.noise, options_.weights.least_free_noise);
  const std::size_t first = weights_.size() - free_.count();
  for (std::size_t i = 0; i < free_.count(); ++i) {
    const double weight = distances_.radial[i] < 0.0 ? distances_.euclidean_share[i] / noise : 0.0;
    const double deviations = weight * distances_.radial[i];
    c.cost += 0.5 * deviations * deviations;
    weights_[first + i] = weight;
  }
}

void Refinement::improve(Candidate& c, int steps) {
  Matrix reference;
  const Parameters rest = parameters_of(c.shape, reference);
  const WeightedResiduals residuals{places_, weights_, reference, rest, count_, FitMethod::robust};
  ceres::TinySolver<WeightedResiduals> solver;
  solver.options.max_num_iterations = steps + 1;
  solver.options.initial_trust_region_radius = 1e2;
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(rest.data(), count_);
  solver.Solve(residuals, &x);
  if (!x.allFinite()) return;
  Parameters moved = rest;
  std::copy_n(x.data(), count_, moved.begin());
  const Superquadric next = shape_from(moved, reference);
  constexpr double kMost = 30.0;  // of the evidence's own scale, which is 1
  if (std::max({next.size_m.x, next.size_m.y, next.size_m.z}) < kMost &&
      std::min({next.size_m.x, next.size_m.y, next.size_m.z}) > 1e-4)
    c.shape = next;
}

}  // namespace palpable::sculpt
