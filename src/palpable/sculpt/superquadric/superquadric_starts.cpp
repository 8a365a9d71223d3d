// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_starts.hpp"

#include "palpable/sculpt/superquadric/independent_axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

namespace palpable::sculpt {
namespace {

using models::Superquadric;

/// Scatter by Tyler's M-estimator: a far point counts only by its direction.
Eigen::Matrix3d robust_scatter(std::span<const Vec3> points, Vec3 centre) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Identity();
  constexpr int kRounds = 6;
  for (int k = 0; k < kRounds; ++k) {
    const Eigen::Matrix3d inverse = scatter.inverse();
    Eigen::Matrix3d next = 1e-6 * Eigen::Matrix3d::Identity();
    for (const Vec3 p : points) {
      const Eigen::Vector3d d(p.x - centre.x, p.y - centre.y, p.z - centre.z);
      const double length = d.dot(inverse * d);
      if (length > 1e-12) next += d * d.transpose() / length;
    }
    scatter = 3.0 * next / next.trace();
  }
  return scatter;
}

std::array<double, 9> rows_of(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

/// The distance from the centre along an axis within which this share of the points lies.
double spread_along(std::span<const Vec3> points, Vec3 centre, Eigen::Vector3d axis, double share) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const Vec3 p : points) values.push_back(std::abs(dot(p - centre, Vec3{axis.x(), axis.y(), axis.z()})));
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(std::min(share * static_cast<double>(values.size()), last));
  std::nth_element(values.begin(), at, values.end());
  return std::max(*at, 0.02);
}

Candidate start_at(const Evidence& evidence, Vec3 centre, const Eigen::Matrix3d& axes,
                   const FitStartOptions& options) {
  Candidate c;
  c.shape.e1 = c.shape.e2 = options.exponent;
  c.shape.scene_from_shape = {rows_of(axes), centre, 1.0};
  const auto half = [&](int k) {
    return spread_along(evidence.points, centre, axes.col(k), options.core_share);
  };
  c.shape.size_m = {half(0), half(1), half(2)};
  c.noise = options.noise;
  c.sight_noise = options.noise;
  c.outliers = options.outliers;
  return c;
}

/// The centre of a solid seen from one side: behind its points by a share of their median distance from the
/// axis of view.
Vec3 centre_behind(const Evidence& evidence, Vec3 median, double share) {
  const Vec3 away = unit(median - *evidence.eye);
  std::vector<double> across;
  for (const Vec3 p : evidence.points) {
    const Vec3 d = p - median;
    across.push_back(norm(d - dot(d, away) * away));
  }
  return median + share * median_of(std::move(across)) * away;
}

}  // namespace

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Vec3 median_of(std::span<const Vec3> points) {
  std::vector<double> values(points.size());
  const auto along = [&](double Vec3::*axis) {
    std::transform(points.begin(), points.end(), values.begin(), [&](Vec3 p) { return p.*axis; });
    return median_of(values);
  };
  return {along(&Vec3::x), along(&Vec3::y), along(&Vec3::z)};
}

std::vector<Candidate> starts_for(const Evidence& evidence, const FitStartOptions& options) {
  Vec3 centre = median_of(evidence.points);
  if (evidence.eye) centre = centre_behind(evidence, centre, options.centre_behind);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(robust_scatter(evidence.points, centre));
  Eigen::Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  std::vector<Candidate> starts;
  constexpr double kQuarter = 0.785398163397448;
  for (int z = 0; z < 3; ++z) {
    Eigen::Matrix3d cycled;
    cycled << axes.col((z + 1) % 3), axes.col((z + 2) % 3), axes.col(z);
    starts.push_back(start_at(evidence, centre, cycled, options));
    const Eigen::Matrix3d turned = cycled * Eigen::AngleAxisd(kQuarter, Eigen::Vector3d::UnitZ());
    starts.push_back(start_at(evidence, centre, turned, options));
  }
  // Principal axes of similar widths are arbitrary.
  const Eigen::Vector3d& widths = principal.eigenvalues();
  const bool similar =
      widths[1] < options.similar_scatter * widths[0] || widths[2] < options.similar_scatter * widths[1];
  if (!evidence.eye && similar) {
    const auto [x, y, z] = independent_axes(evidence.points, centre);
    axes << x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z;
    starts.push_back(start_at(evidence, centre, axes, options));
  }
  return starts;
}

std::vector<Candidate> switched(const Candidate& c, const FitStartOptions& options) {
  std::vector<Candidate> others;
  const auto& r = c.shape.scene_from_shape.rotation;
  const Vec3 a = c.shape.size_m;
  const auto with = [&](std::array<std::size_t, 3> columns, Vec3 size, double e1, double e2) {
    Candidate other = c;
    other.shape.size_m = size;
    other.shape.e1 = e1;
    other.shape.e2 = e2;
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column)
        other.shape.scene_from_shape.rotation[3 * row + column] = r[3 * row + columns[column]];
    others.push_back(other);
  };
  const double mean = 0.5 * (c.shape.e1 + c.shape.e2);
  with({1, 2, 0}, {a.y, a.z, a.x}, mean, c.shape.e1);
  with({2, 0, 1}, {a.z, a.x, a.y}, mean, c.shape.e1);
  if (std::max(a.x, a.y) < options.square_section * std::min(a.x, a.y)) {
    Candidate other = c;
    const Transform<models::ShapeFrame, models::ShapeFrame> turn{
        {std::sqrt(0.5), -std::sqrt(0.5), 0, std::sqrt(0.5), std::sqrt(0.5), 0, 0, 0, 1}, {}, 1.0};
    other.shape.scene_from_shape = c.shape.scene_from_shape * turn;
    other.shape.e2 = std::clamp(2.0 - c.shape.e2, 0.15, 1.85);
    // A corner of one section is the middle of a side of the other.
    const double grown = std::pow(2.0, 0.5 * (1.0 - c.shape.e2));
    const double half = 0.5 * (a.x + a.y) * grown;
    other.shape.size_m = {half, half, a.z};
    others.push_back(other);
  }
  for (Candidate& other : others) {
    other.noise = std::max(options.switched_noise_factor * c.noise, options.least_switched_noise);
    other.sight_noise = std::max(options.switched_noise_factor * c.sight_noise, options.least_switched_noise);
  }
  return others;
}

std::vector<Candidate> deformed(const Candidate& c, int parameters, const FitStartOptions& options) {
  std::vector<Candidate> axes = switched(c, options);
  axes.resize(2);
  axes.push_back(c);
  std::vector<Candidate> bodies;
  for (Candidate& plain : axes) {
    plain.noise = std::max(plain.noise, options.least_switched_noise);
    plain.sight_noise = std::max(plain.sight_noise, options.least_switched_noise);
    bodies.push_back(plain);
    for (const double taper : {-options.taper, options.taper}) {
      Candidate other = plain;
      other.shape.taper_x = other.shape.taper_y = taper;
      if (parameters == kTaperParameters) bodies.push_back(other);
    }
    constexpr int kBendDirections = 4;
    constexpr double kHalfPi = 1.570796326794897;
    for (int k = 0; k < kBendDirections && parameters == kBendParameters; ++k) {
      Candidate other = plain;
      const Vec3 a = plain.shape.size_m;
      other.shape.bend_per_m = std::min(0.5 / a.z, 0.5 / std::hypot(a.x, a.y));
      other.shape.bend_angle_rad = k * kHalfPi;
      bodies.push_back(other);
    }
  }
  return bodies;
}

Superquadric start_from_moments(std::span<const Vec3> points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Vec3 p : points) mean += Eigen::Vector3d(p.x, p.y, p.z);
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Vec3 p : points) {
    const Eigen::Vector3d d = Eigen::Vector3d(p.x, p.y, p.z) - mean;
    moments += d * d.transpose() / static_cast<double>(points.size());
  }
  // The axis of the most different moment becomes z.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(moments);
  const Eigen::Vector3d& values = principal.eigenvalues();
  const int z = values[2] - values[1] > values[1] - values[0] ? 2 : 0;
  Eigen::Matrix3d axes;
  axes << principal.eigenvectors().col((z + 1) % 3), principal.eigenvectors().col((z + 2) % 3),
      principal.eigenvectors().col(z);
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  Superquadric shape;
  shape.scene_from_shape = {rows_of(axes), {mean.x(), mean.y(), mean.z()}, 1.0};
  const auto half = [&](int k) { return std::sqrt(std::max(3.0 * values[k], 1e-4)); };
  shape.size_m = {half((z + 1) % 3), half((z + 2) % 3), half(z)};
  return shape;
}

}  // namespace palpable::sculpt
