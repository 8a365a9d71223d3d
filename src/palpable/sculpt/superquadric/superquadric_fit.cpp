// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_fit.hpp"

#include "palpable/sculpt/superquadric/fit_normalisation.hpp"
#include "palpable/sculpt/superquadric/superquadric_starts.hpp"

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

constexpr double kRoot2Pi = 2.50662827463100050;

/// Evenly chosen members of a list: every k-th.
template <class T>
std::vector<T> thinned(std::span<const T> all, std::size_t most) {
  if (all.size() <= most) return {all.begin(), all.end()};
  std::vector<T> some;
  some.reserve(most);
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}

/// Residuals for Ceres' small dense solver. The weights, and the points where lines of sight touch, are fixed
/// while it runs.
struct WeightedResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  const Columns& places;
  const std::vector<double>& weights;
  const Matrix& reference;
  const Parameters& rest;
  int count;
  FitMethod method;

  int NumResiduals() const { return static_cast<int>(places.count()); }
  int NumParameters() const { return count; }

  bool operator()(const double* at, double* residuals, double* jacobian) const {
    Parameters parameters = rest;
    std::copy_n(at, count, parameters.begin());
    const ResidualsAt here(parameters, reference, count);
    if (method == FitMethod::robust) {
      here.radial_rows_of(places, weights, residuals, jacobian);
      return true;
    }
    const std::size_t rows = places.count();
    for (std::size_t i = 0; i < rows; ++i) {
      const Residual r = here.solina_with_derivatives(places.at(i));
      residuals[i] = r.value;
      if (jacobian == nullptr) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) jacobian[k * rows + i] = r.by[k];
    }
    return true;
  }
};

/// Roughly the surface's area: that of a box, less its corners.
double area_of(const Superquadric& s) {
  return 6.0 * (s.size_m.x * s.size_m.y + s.size_m.y * s.size_m.z + s.size_m.z * s.size_m.x);
}

/// Expectation and maximisation in turn (as Liu et al. 2022). A point is an inlier, near the surface with
/// Gaussian noise, or an outlier, anywhere in the evidence's box. The probability of being an inlier weights
/// it in a few steps of Levenberg-Marquardt on the radial distance, corrected to a Euclidean one to first
/// order.
class Refinement {
 public:
  Refinement(const Evidence& evidence, double volume, int count, const FitOptions& options)
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

  /// Ends early if the cost does not change any more, or would not fall below `to_beat` even if each further
  /// round gained more than the last one (FitSearchOptions::hoped_gain).
  void run(Candidate& c, int rounds, int steps, double to_beat = std::numeric_limits<double>::infinity()) {
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

  /// Whether the points are much farther from the candidate than can be of use.
  bool hopeless(const Candidate& c, const FitExpectation& expected) {
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

  /// Share of inliers, and their mean distance.
  double inlier_share() const { return inliers_; }
  double error() const { return error_; }

 private:
  double area_seen(const Candidate& c) const { return (evidence_.eye ? 0.5 : 1.0) * area_of(c.shape); }

  /// Estimates each point's probability of being an inlier, the noise, and the candidate's cost: minus the
  /// logarithm of the evidence's likelihood.
  void weigh(Candidate& c) {
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

  void weigh_outline(const ResidualsAt& here, Candidate& c) {
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

  /// A free place inside of the shape pulls the surface inwards, one outside has no weight.
  void weigh_free(const ResidualsAt& here, Candidate& c) {
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

  void improve(Candidate& c, int steps) {
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
