// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_fit.hpp"

#include "palpable/sculpt/superquadric/fit_normalisation.hpp"
#include "palpable/sculpt/superquadric/superquadric_refinement.hpp"
#include "palpable/sculpt/superquadric/superquadric_starts.hpp"
#include "palpable/sculpt/superquadric/weighted_residuals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Dense>
#include <ceres/tiny_solver.h>

namespace palpable::sculpt {
namespace {

using models::Superquadric;
using Matrix = std::array<double, 9>;

/// Evenly chosen members of a list: every k-th.
template <class T>
std::vector<T> thinned(std::span<const T> all, std::size_t most) {
  if (all.size() <= most) return {all.begin(), all.end()};
  std::vector<T> some;
  some.reserve(most);
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}

double volume_of(std::span<const Vec3> points) {
  Vec3 low = points.front();
  Vec3 high = low;
  for (const Vec3 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 d = high - low;
  return std::max(d.x * d.y * d.z, 1e-6);
}

bool cheaper(const Candidate& a, const Candidate& b) { return a.cost < b.cost; }

/// The best of several starts, by a search over a part of the evidence.
Candidate best_plain_shape(const Evidence& some, Refinement& quick, const FitOptions& options,
                           const FitExpectation& expected) {
  const FitSearchOptions& search = options.search;
  auto candidates = starts_for(some, options.starts);
  for (Candidate& c : candidates) quick.run(c, search.start_rounds, search.start_steps);
  // With many outliers, and for half views, another round is needed to see which candidates converge.
  const double outliers = std::min_element(candidates.begin(), candidates.end(), cheaper)->outliers;
  if (some.eye || outliers > search.many_outliers)
    for (Candidate& c : candidates) quick.run(c, 1, search.start_steps);
  std::sort(candidates.begin(), candidates.end(), cheaper);
  Candidate best = candidates[0];
  quick.run(best, search.best_rounds, search.best_steps);
  quick.run(candidates[1], search.best_rounds, search.best_steps, best.cost);
  if (candidates[1].cost < best.cost) best = candidates[1];
  if (quick.hopeless(best, expected)) return best;
  // From one local minimum to the next, while the cost falls.
  for (int k = 0; k < search.switches; ++k) {
    const double before = best.cost;
    for (Candidate& other : switched(best, options.starts)) {
      quick.run(other, search.switched_rounds, search.switched_steps, best.cost);
      if (other.cost < best.cost) best = other;
    }
    if (best.cost > before - search.settled_cost * static_cast<double>(some.points.size())) break;
  }
  return best;
}

Candidate best_deformed_shape(const Evidence& some, double volume, const Candidate& plain,
                              const FitOptions& options, const FitExpectation& expected) {
  const FitSearchOptions& search = options.search;
  const int count = parameter_count(options.deformation);
  Refinement deforming(some, volume, count, options);
  std::vector<Candidate> bodies = deformed(plain, count, options.starts);
  for (Candidate& c : bodies) deforming.run(c, search.deformed_rounds, search.deformed_steps);
  std::sort(bodies.begin(), bodies.end(), cheaper);
  bodies.resize(std::min(bodies.size(), static_cast<std::size_t>(search.deformed_kept)));
  Candidate best = bodies[0];
  if (deforming.hopeless(best, expected)) return best;
  for (Candidate& c : bodies) {
    deforming.run(c, search.last_deformed_rounds, search.last_deformed_steps, best.cost);
    if (c.cost < best.cost) best = c;
  }
  return best;
}

bool is_plain(const Superquadric& s) { return s.taper_x == 0.0 && s.taper_y == 0.0 && s.bend_per_m == 0.0; }

/// The shape near `start` that fits a part of the evidence best.
Candidate best_shape_near(const Superquadric& start, Refinement& quick, const FitOptions& options) {
  Candidate near;
  near.shape = start;
  near.noise = near.sight_noise = options.starts.least_switched_noise;
  near.outliers = options.starts.outliers;
  quick.run(near, options.search.best_rounds, options.search.best_steps);
  return near;
}

FittedSuperquadric fit_robustly(const Evidence& all, const FitOptions& options,
                                const FitExpectation& expected) {
  const FitSearchOptions& search = options.search;
  const double volume = volume_of(all.points);
  const Evidence some{thinned<Vec3>(all.points, static_cast<std::size_t>(search.points)),
                      thinned<LineOfSight>(all.outline, static_cast<std::size_t>(search.sights)),
                      thinned<Vec3>(all.free, static_cast<std::size_t>(search.free)), all.eye};
  const bool deformed_start = expected.start && !is_plain(*expected.start);
  Refinement quick(some, volume, deformed_start ? parameter_count(options.deformation) : kPlainParameters,
                   options);
  Candidate best = expected.start ? best_shape_near(*expected.start, quick, options)
                                  : best_plain_shape(some, quick, options, expected);
  if (options.deformation != FitDeformation::none && !deformed_start)
    best = best_deformed_shape(some, volume, best, options, expected);
  const Evidence every{all.points,
                       thinned<LineOfSight>(all.outline, static_cast<std::size_t>(search.last_sights)),
                       all.free, all.eye};
  Refinement whole(every, volume, parameter_count(options.deformation), options);
  best.noise *= search.last_noise_factor;
  best.sight_noise *= search.last_noise_factor;
  whole.run(best, search.last_rounds, search.last_steps);
  return {best.shape, best.noise, whole.inlier_share(), whole.error()};
}

/// The papers' method: one start from the second moments, one run.
FittedSuperquadric fit_as_solina(const Evidence& all, FitDeformation deformation) {
  const Superquadric shape = start_from_moments(all.points);
  Matrix reference;
  const Parameters rest = parameters_of(shape, reference);
  Columns places(all.points.size());
  for (std::size_t i = 0; i < all.points.size(); ++i) places.set(i, all.points[i]);
  const std::vector<double> ones(all.points.size(), 1.0);
  const int count = parameter_count(deformation);
  const WeightedResiduals residuals{places, ones, reference, rest, count, FitMethod::solina};
  ceres::TinySolver<WeightedResiduals> solver;
  solver.options.max_num_iterations = 60;
  solver.options.function_tolerance = 1e-9;
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(rest.data(), count);
  solver.Solve(residuals, &x);
  Parameters moved = rest;
  if (x.allFinite()) std::copy_n(x.data(), count, moved.begin());
  const ResidualsAt here(moved, reference, count);
  RadialDistances distances;
  here.radial_distances_of(places, distances);
  double squares = 0.0;
  double lengths = 0.0;
  for (std::size_t i = 0; i < places.count(); ++i) {
    const double r = distances.euclidean_share[i] * distances.radial[i];
    squares += r * r;
    lengths += std::abs(r);
  }
  const auto n = static_cast<double>(all.points.size());
  return {here.shape(), std::sqrt(squares / n), 1.0, lengths / n};
}

}  // namespace

Result<FittedSuperquadric> fit_superquadric(std::span<const Vec3> points_m,
                                            const std::optional<FitView>& view, const FitOptions& options,
                                            std::span<const Vec3> free_m, const FitExpectation& expected) {
  if (auto valid = check(options); !valid) return std::move(valid).error();
  const auto normal = normalisation_of(points_m);
  if (!normal) return normal.error();
  Evidence evidence;
  evidence.points.reserve(points_m.size());
  for (const Vec3 p : points_m) evidence.points.push_back(normal->in(p));
  for (const Vec3 p : free_m) evidence.free.push_back(normal->in(p));
  if (view) {
    evidence.eye = normal->in(view->eye.v);
    for (const LineOfSight& sight : view->outline)
      evidence.outline.push_back({normal->in(sight.origin_m), sight.direction});
  }
  FitExpectation normalised{
      {}, expected.most_deviation_m / normal->scale, expected.truncated_m / normal->scale};
  if (expected.start) normalised.start = normal->in(*expected.start);
  FittedSuperquadric fitted = options.method == FitMethod::solina
                                  ? fit_as_solina(evidence, options.deformation)
                                  : fit_robustly(evidence, options, normalised);
  fitted.shape = normal->out(fitted.shape);
  fitted.noise_m *= normal->scale;
  fitted.error_m *= normal->scale;
  return fitted;
}

}  // namespace palpable::sculpt
