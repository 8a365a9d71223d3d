// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_fit.hpp"

#include "palpable/sculpt/superquadric/superquadric_starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Dense>
#include <ceres/tiny_solver.h>

namespace palpable::sculpt {
namespace {

using models::Superquadric;
using Matrix = std::array<double, 9>;

constexpr double kRoot2Pi = 2.50662827463100050;
constexpr std::size_t kFewestPoints = 12;

/// Evenly chosen members of a list: every k-th.
template <class T>
std::vector<T> thinned(std::span<const T> all, std::size_t most) {
  if (all.size() <= most) return {all.begin(), all.end()};
  std::vector<T> some;
  some.reserve(most);
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}

/// Residuals for Ceres' small dense solver: weights, and where lines of sight graze, are held while it runs.
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

/// Expectation and maximisation in turn (as Liu et al. 2022): points lie near the surface with Gaussian noise
/// or anywhere in the evidence's box; how much each is believed weighs it in a few steps of
/// Levenberg-Marquardt on the radial distance, made Euclidean to first order.
class Refinement {
 public:
  Refinement(const Evidence& evidence, double volume, int count)
      : evidence_(evidence),
        volume_(volume),
        count_(count),
        points_(evidence.points.size()),
        places_(evidence.points.size() + evidence.outline.size()),
        weights_(places_.count()) {
    for (std::size_t i = 0; i < evidence.points.size(); ++i) {
      points_.set(i, evidence.points[i]);
      places_.set(i, evidence.points[i]);
    }
  }

  /// Ends early where the cost can no longer fall below `to_beat`, if each round gains twice what the last
  /// one did.
  void run(Candidate& c, int rounds, int steps, double to_beat = std::numeric_limits<double>::infinity()) {
    double noise = 0.0;
    double cost = std::numeric_limits<double>::infinity();
    for (int k = 0; k < rounds; ++k) {
      noise = c.noise;
      weigh(c);
      // Settled: neither what is believed nor the shape moves any more.
      const bool settled =
          c.noise > 0.97 * noise && cost - c.cost < 1e-3 * static_cast<double>(points_.count());
      if (k > 0 && settled) return;
      constexpr int kFirstSign = 3;
      constexpr double kHope = 2.0;
      if (k >= kFirstSign && c.cost - to_beat > kHope * (rounds - k) * std::max(cost - c.cost, 0.0)) return;
      cost = c.cost;
      improve(c, steps);
    }
    weigh(c);
  }

  /// Share of the points that are believed to be of the surface, and their mean distance.
  double inlier_share() const { return inliers_; }
  double error() const { return error_; }

 private:
  double area_seen(const Candidate& c) const { return (evidence_.eye ? 0.5 : 1.0) * area_of(c.shape); }

  /// How much each point is believed, the noise that this leaves, and the cost that candidates are chosen by:
  /// minus the logarithm of the evidence's likelihood.
  void weigh(Candidate& c) {
    Matrix reference;
    const Parameters parameters = parameters_of(c.shape, reference);
    const ResidualsAt here(parameters, reference, count_);
    const double inlier = (1.0 - c.outliers) / (kRoot2Pi * c.noise * area_seen(c));
    const double ratio = c.outliers / volume_ / inlier;
    const double narrow = -0.5 / (c.noise * c.noise);
    double sum = 0.0;
    double squares = 0.0;
    double lengths = 0.0;
    const auto all = static_cast<double>(points_.count());
    c.cost = -all * std::log(inlier);
    here.radial_distances_of(points_, distances_);
    for (std::size_t i = 0; i < points_.count(); ++i) {
      const double r = distances_.euclidean_share[i] * distances_.radial[i];
      // A point on the side that could not be seen is no point of this shape.
      const bool seen = !evidence_.eye || here.faces(points_.at(i), distances_.outward.at(i), *evidence_.eye);
      const double near = seen ? std::exp(narrow * r * r) : 0.0;
      const double belief = near / (near + ratio);
      c.cost -= std::log(near + ratio);
      weights_[i] = std::sqrt(belief) * distances_.euclidean_share[i];
      sum += belief;
      squares += belief * r * r;
      lengths += belief * std::abs(r);
    }
    if (sum > kFewestBelieved * all) {
      // Far from the end, noise is mostly misfit and must not be believed: it is made to fall.
      const double most = c.noise > kCoarse ? 0.85 * c.noise : c.noise;
      c.noise = std::clamp(std::sqrt(squares / sum), kLeastNoise, most);
      c.outliers = std::clamp(1.0 - sum / all, 0.01, 0.8);
      error_ = lengths / sum;
    }
    inliers_ = sum / all;
    for (std::size_t i = 0; i < points_.count(); ++i) weights_[i] /= c.noise;
    if (!evidence_.outline.empty()) weigh_outline(here, c);
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
      constexpr double kStray = 0.1;
      constexpr double kStrayCost = 1e-3;
      const double belief = near / (near + kStray);
      c.cost -= std::log((near + kStrayCost) / c.sight_noise);
      sum += belief;
      squares += belief * r * r;
      places_.set(first + i, grazes.at(i));
      weights_[first + i] = std::sqrt(belief) * distances_.euclidean_share[i];
    }
    if (sum > 0.1 * static_cast<double>(grazes.count()))
      c.sight_noise = std::clamp(std::sqrt(squares / sum), kLeastNoise, c.sight_noise);
    for (std::size_t i = first; i < weights_.size(); ++i) weights_[i] /= c.sight_noise;
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

  static constexpr double kLeastNoise = 1e-5;  // of the evidence's scale
  static constexpr double kFewestBelieved = 0.02;
  static constexpr double kCoarse = 0.04;
  const Evidence& evidence_;
  double volume_;
  int count_;
  Columns points_;
  Columns places_;  // the points, then where the lines of sight graze
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

int count_for(FitDeformation deformation) {
  switch (deformation) {
    case FitDeformation::none:
      return kPlainParameters;
    case FitDeformation::taper:
      return kTaperParameters;
    case FitDeformation::taper_and_bend:
      break;
  }
  return kBendParameters;
}

bool cheaper(const Candidate& a, const Candidate& b) { return a.cost < b.cost; }

FittedSuperquadric fit_robustly(const Evidence& all, FitDeformation deformation) {
  const double volume = volume_of(all.points);
  constexpr std::size_t kFewPoints = 150;
  constexpr std::size_t kFewSights = 36;
  const Evidence some{thinned<Vec3>(all.points, kFewPoints), thinned<Sight>(all.outline, kFewSights),
                      all.eye};
  Refinement quick(some, volume, kPlainParameters);
  auto candidates = starts_for(some);
  for (Candidate& c : candidates) quick.run(c, 3, 2);
  // Among outliers, and of half views, another round is needed to find out which of them converge.
  constexpr double kManyOutliers = 0.1;
  const double outliers = std::min_element(candidates.begin(), candidates.end(), cheaper)->outliers;
  if (some.eye || outliers > kManyOutliers)
    for (Candidate& c : candidates) quick.run(c, 1, 2);
  std::sort(candidates.begin(), candidates.end(), cheaper);
  Candidate best = candidates[0];
  quick.run(best, 6, 3);
  quick.run(candidates[1], 6, 3, best.cost);
  if (candidates[1].cost < best.cost) best = candidates[1];
  // From valley to valley, while that helps.
  constexpr int kMostSwitches = 4;
  for (int k = 0; k < kMostSwitches; ++k) {
    const double before = best.cost;
    for (Candidate& other : switched(best)) {
      quick.run(other, 8, 3, best.cost);
      if (other.cost < best.cost) best = other;
    }
    if (best.cost > before - 1e-3 * static_cast<double>(some.points.size())) break;
  }
  if (deformation != FitDeformation::none) {
    Refinement deforming(some, volume, count_for(deformation));
    std::vector<Candidate> bodies = deformed(best, count_for(deformation));
    for (Candidate& c : bodies) deforming.run(c, 4, 3);
    std::sort(bodies.begin(), bodies.end(), cheaper);
    constexpr std::size_t kPromising = 4;
    bodies.resize(std::min(bodies.size(), kPromising));
    best = bodies[0];
    for (Candidate& c : bodies) {
      deforming.run(c, 12, 4, best.cost);
      if (c.cost < best.cost) best = c;
    }
  }
  constexpr std::size_t kEnoughSights = 240;
  const Evidence every{all.points, thinned<Sight>(all.outline, kEnoughSights), all.eye};
  Refinement whole(every, volume, count_for(deformation));
  best.noise *= 1.5;
  best.sight_noise *= 1.5;
  whole.run(best, 6, 3);
  return {best.shape, best.noise, whole.inlier_share(), whole.error()};
}

/// The papers' way: one start from the second moments, one run.
FittedSuperquadric fit_as_solina(const Evidence& all, FitDeformation deformation) {
  const Superquadric shape = start_from_moments(all.points);
  Matrix reference;
  const Parameters rest = parameters_of(shape, reference);
  Columns places(all.points.size());
  for (std::size_t i = 0; i < all.points.size(); ++i) places.set(i, all.points[i]);
  const std::vector<double> ones(all.points.size(), 1.0);
  const int count = count_for(deformation);
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

/// Evidence moved and scaled so that its middle is 0 and its size about 1, and shapes moved back.
struct Normalisation {
  Vec3 centre;
  double scale = 1.0;

  Vec3 in(Vec3 p) const { return (p - centre) / scale; }
  Superquadric out(Superquadric s) const {
    s.size_m *= scale;
    s.bend_per_m /= scale;
    Vec3& t = s.scene_from_shape.translation_m;
    t = scale * t + centre;
    return s;
  }
};

Result<Normalisation> normalisation_of(std::span<const Vec3> points) {
  if (points.size() < kFewestPoints) return invalid_input("a superquadric needs at least 12 points");
  if (!std::all_of(points.begin(), points.end(), [](Vec3 p) { return is_finite(p); }))
    return invalid_input("a point's position is not a finite number");
  const Vec3 centre = median_of(points);
  std::vector<double> lengths;
  lengths.reserve(points.size());
  for (const Vec3 p : points) lengths.push_back(norm(p - centre));
  const double scale = median_of(std::move(lengths));
  if (!(scale > 0.0)) return invalid_input("the points are all at one place");
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Vec3 p : points) {
    const Vec3 d = (p - centre) / scale;
    moments += Eigen::Vector3d(d.x, d.y, d.z) * Eigen::RowVector3d(d.x, d.y, d.z);
  }
  const Eigen::Vector3d values = moments.selfadjointView<Eigen::Lower>().eigenvalues();
  if (values[0] < 1e-8 * values[2])
    return invalid_input("the points lie on one plane or line, which no solid is fitted to");
  return Normalisation{centre, scale};
}

}  // namespace

Result<FittedSuperquadric> fit_superquadric(std::span<const Vec3> points_m,
                                            const std::optional<FitView>& view, const FitOptions& options) {
  const auto normal = normalisation_of(points_m);
  if (!normal) return normal.error();
  Evidence evidence;
  evidence.points.reserve(points_m.size());
  for (const Vec3 p : points_m) evidence.points.push_back(normal->in(p));
  if (view) {
    evidence.eye = normal->in(view->eye.v);
    for (const Sight& sight : view->outline)
      evidence.outline.push_back({normal->in(sight.origin_m), sight.direction});
  }
  FittedSuperquadric fitted = options.method == FitMethod::solina
                                  ? fit_as_solina(evidence, options.deformation)
                                  : fit_robustly(evidence, options.deformation);
  fitted.shape = normal->out(fitted.shape);
  fitted.noise_m *= normal->scale;
  fitted.error_m *= normal->scale;
  return fitted;
}

std::vector<Sight> outline_of(const Raster<std::uint8_t>& labels, std::uint8_t label, const Pinhole& camera,
                              const Transform<SceneFrame, CameraFrame>& scene_from_camera) {
  std::vector<Sight> sights;
  const Vec3 eye = (scene_from_camera * Point<CameraFrame>{}).v;
  const auto add = [&](double x, double y) {
    const Vec3 along{(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0};
    sights.push_back({eye, unit(scene_from_camera.rotate(along))});
  };
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const bool here = labels(x, y) == label;
      if (x + 1 < labels.width() && here != (labels(x + 1, y) == label)) add(x + 0.5, y);
      if (y + 1 < labels.height() && here != (labels(x, y + 1) == label)) add(x, y + 0.5);
    }
  return sights;
}

}  // namespace palpable::sculpt
