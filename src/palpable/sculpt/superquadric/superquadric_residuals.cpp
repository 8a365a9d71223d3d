// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_residuals.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::sculpt {
namespace {

using models::Superquadric;

constexpr double kLeast = models::kLeastExponent;
constexpr double kSpan = models::kGreatestExponent - models::kLeastExponent;
constexpr double kMostTaper = 0.95;
constexpr double kMostSigmoid = 8.0;

double sigmoid(double s) { return 1.0 / (1.0 + std::exp(-std::clamp(s, -kMostSigmoid, kMostSigmoid))); }
double inverse_sigmoid(double y) {
  const double held = std::clamp(y, 0.002, 0.998);
  return std::log(held / (1.0 - held));
}

using Matrix = std::array<double, 9>;

Vec3 times(const Matrix& m, Vec3 v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
          m[6] * v.x + m[7] * v.y + m[8] * v.z};
}
Vec3 transposed_times(const Matrix& m, Vec3 v) {
  return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
          m[2] * v.x + m[5] * v.y + m[8] * v.z};
}

/// I + a [w]x + b [w]x^2.
Matrix turn_series(Vec3 w, double a, double b) {
  const double n = squared_norm(w);
  return {1.0 + b * (w.x * w.x - n), b * w.x * w.y - a * w.z,   b * w.x * w.z + a * w.y,
          b * w.x * w.y + a * w.z,   1.0 + b * (w.y * w.y - n), b * w.y * w.z - a * w.x,
          b * w.x * w.z - a * w.y,   b * w.y * w.z + a * w.x,   1.0 + b * (w.z * w.z - n)};
}

Matrix rotation_by(Vec3 w) {
  const double angle = norm(w);
  if (angle < 1e-8) return turn_series(w, 1.0, 0.5);
  return turn_series(w, std::sin(angle) / angle, (1.0 - std::cos(angle)) / (angle * angle));
}

Matrix right_jacobian(Vec3 w) {
  const double angle = norm(w);
  if (angle < 1e-4) return turn_series(w, -0.5, 1.0 / 6.0);
  const double n = angle * angle;
  return turn_series(w, -(1.0 - std::cos(angle)) / n, (angle - std::sin(angle)) / (n * angle));
}

/// x ln x, 0 at 0.
double entropy(double x) { return x > 0.0 ? x * std::log(x) : 0.0; }

}  // namespace

Superquadric shape_from(const Parameters& p, const Matrix& reference) {
  Superquadric s;
  s.size_m = {std::exp(p[6]), std::exp(p[7]), std::exp(p[8])};
  s.e1 = kLeast + kSpan * sigmoid(p[9]);
  s.e2 = kLeast + kSpan * sigmoid(p[10]);
  s.taper_x = kMostTaper * std::tanh(p[11]);
  s.taper_y = kMostTaper * std::tanh(p[12]);
  const Transform<SceneFrame, models::ShapeFrame> before{reference, {}, 1.0};
  const Transform<models::ShapeFrame, models::ShapeFrame> turn{rotation_by({p[3], p[4], p[5]}), {}, 1.0};
  s.scene_from_shape = before * turn;
  s.scene_from_shape.translation_m = {p[0], p[1], p[2]};
  // The bend is a vector of curvature, limited so that the body does not reach its centre of curvature.
  const double reach = std::hypot(s.size_m.x, s.size_m.y) * (1.0 + kMostTaper);
  const double most = std::min(0.95 / reach, 3.0 / s.size_m.z);
  s.bend_per_m = std::min(std::hypot(p[13], p[14]), most);
  s.bend_angle_rad = s.bend_per_m > 0.0 ? std::atan2(p[14], p[13]) : 0.0;
  return s;
}

Parameters parameters_of(const Superquadric& s, Matrix& reference) {
  reference = s.scene_from_shape.rotation;
  const Vec3 t = s.scene_from_shape.translation_m;
  return {t.x,
          t.y,
          t.z,
          0.0,
          0.0,
          0.0,
          std::log(s.size_m.x),
          std::log(s.size_m.y),
          std::log(s.size_m.z),
          inverse_sigmoid((s.e1 - kLeast) / kSpan),
          inverse_sigmoid((s.e2 - kLeast) / kSpan),
          std::atanh(std::clamp(s.taper_x / kMostTaper, -0.99, 0.99)),
          std::atanh(std::clamp(s.taper_y / kMostTaper, -0.99, 0.99)),
          s.bend_per_m * std::cos(s.bend_angle_rad),
          s.bend_per_m * std::sin(s.bend_angle_rad)};
}

ResidualsAt::ResidualsAt(const Parameters& parameters, const Matrix& reference, int count)
    : shape_(shape_from(parameters, reference)),
      parameters_(parameters),
      count_(count),
      turned_(right_jacobian({parameters[3], parameters[4], parameters[5]})) {
  const auto pace = [&](double e) { return (e - kLeast) * (1.0 - (e - kLeast) / kSpan); };
  e1_rate_ = pace(shape_.e1);
  e2_rate_ = pace(shape_.e2);
}

Vec3 ResidualsAt::local(Vec3 p) const {
  return transposed_times(shape_.scene_from_shape.rotation, p - shape_.scene_from_shape.translation_m);
}

ResidualsAt::Gauge ResidualsAt::gauge_with_derivatives(Vec3 straight) const {
  // With h and f the shares of the two sums' terms, h = u^p / (u^p + v^p) and f = rho^q / (rho^q + w^q),
  // every derivative is short: dG/dx = f h G / x, dG/de1 = -G/2 (f ln f + (1 - f) ln (1 - f)).
  constexpr double kAtPlane = 1e-9;
  const Vec3 a = shape_.size_m;
  const Vec3 held{std::max(std::abs(straight.x), kAtPlane * a.x),
                  std::max(std::abs(straight.y), kAtPlane * a.y),
                  std::max(std::abs(straight.z), kAtPlane * a.z)};
  const double p = 2.0 / shape_.e2;
  const double q = 2.0 / shape_.e1;
  const double log_u = std::log(held.x / a.x);
  const double log_v = std::log(held.y / a.y);
  const double log_w = std::log(held.z / a.z);
  const auto joined = [](double first, double second, double power, double& share) {
    const double d = power * (second - first);
    if (d > 0.0) {
      const double r = std::exp(-d);
      share = r / (1.0 + r);
      return second + std::log1p(r) / power;
    }
    const double r = std::exp(d);
    share = 1.0 / (1.0 + r);
    return first + std::log1p(r) / power;
  };
  double h = 0.0;
  double f = 0.0;
  const double log_rho = joined(log_u, log_v, p, h);
  const double log_g = joined(log_rho, log_w, q, f);
  Gauge g{};
  g.value = std::exp(log_g);
  const Vec3 shares{f * h * g.value, f * (1.0 - h) * g.value, (1.0 - f) * g.value};
  g.by_log_size = -shares;
  g.by_place = {std::copysign(shares.x / held.x, straight.x), std::copysign(shares.y / held.y, straight.y),
                std::copysign(shares.z / held.z, straight.z)};
  g.by_e1 = -0.5 * g.value * (entropy(f) + entropy(1.0 - f));
  g.by_e2 = -0.5 * g.value * f * (entropy(h) + entropy(1.0 - h));
  return g;
}

double ResidualsAt::radial(Vec3 p) const {
  const Vec3 straight = models::undeform(shape_, local(p));
  const double g = models::gauge(shape_, straight);
  return g > 0.0 ? norm(straight) * (1.0 - 1.0 / g) : -shape_.size_m.x;
}

double ResidualsAt::solina(Vec3 p) const {
  const double g = models::gauge(shape_, models::undeform(shape_, local(p)));
  return std::sqrt(shape_.size_m.x * shape_.size_m.y * shape_.size_m.z) * (g * g - 1.0);
}

void ResidualsAt::chain(Vec3 placed, Vec3 straight, Vec3 by_straight, const Gauge& g, double by_gauge,
                        Residual& out) const {
  Vec3 by_local = by_straight;
  double by_log_z = 0.0;
  if (shape_.deformed() || count_ > kPlainParameters) {
    // The inverse of the deformation has no short derivative: central differences with a step of 1e-6 of the
    // size.
    const double step = 1e-6 * shape_.size_m.z;
    const auto moved = [&](Vec3 by) {
      return dot(by_straight, (models::undeform(shape_, placed + by) - straight) / step);
    };
    by_local = {moved({step, 0, 0}), moved({0, step, 0}), moved({0, 0, step})};
    const auto changed = [&](Superquadric other, double by) {
      return dot(by_straight, (models::undeform(other, placed) - straight) / by);
    };
    constexpr double kStep = 1e-6;
    Superquadric other = shape_;
    other.size_m.z *= 1.0 + kStep;
    by_log_z = changed(other, kStep);
    if (count_ >= kTaperParameters) {
      other = shape_;
      other.taper_x += kStep;
      out.by[11] = changed(other, kStep) * (kMostTaper - shape_.taper_x * shape_.taper_x / kMostTaper);
      other = shape_;
      other.taper_y += kStep;
      out.by[12] = changed(other, kStep) * (kMostTaper - shape_.taper_y * shape_.taper_y / kMostTaper);
    }
    if (count_ >= kBendParameters) {
      const double bend_step = kStep / shape_.size_m.z;
      const double bx = shape_.bend_per_m * std::cos(shape_.bend_angle_rad);
      const double by = shape_.bend_per_m * std::sin(shape_.bend_angle_rad);
      const auto bent = [&](double x, double y) {
        other = shape_;
        other.bend_per_m = std::hypot(x, y);
        other.bend_angle_rad = std::atan2(y, x);
        return changed(other, bend_step);
      };
      out.by[13] = bent(bx + bend_step, by);
      out.by[14] = bent(bx, by + bend_step);
    }
  }
  const Vec3 by_place = times(shape_.scene_from_shape.rotation, by_local);
  out.by[0] = -by_place.x;
  out.by[1] = -by_place.y;
  out.by[2] = -by_place.z;
  // Turning the shape by d moves a point in its frame by placed x d.
  const Vec3 by_turn = transposed_times(turned_, cross(by_local, placed));
  out.by[3] = by_turn.x;
  out.by[4] = by_turn.y;
  out.by[5] = by_turn.z;
  out.by[6] = by_gauge * g.by_log_size.x;
  out.by[7] = by_gauge * g.by_log_size.y;
  out.by[8] = by_gauge * g.by_log_size.z + by_log_z;
  out.by[9] = by_gauge * g.by_e1 * e1_rate_;
  out.by[10] = by_gauge * g.by_e2 * e2_rate_;
}

Residual ResidualsAt::radial_with_derivatives(Vec3 p) const {
  const Vec3 placed = local(p);
  const Vec3 straight = models::undeform(shape_, placed);
  const double length = std::max(norm(straight), 1e-12);
  const Gauge g = gauge_with_derivatives(straight);
  const double by_gauge = length / (g.value * g.value);
  Residual out;
  out.value = length * (1.0 - 1.0 / g.value);
  const Vec3 by_straight = (1.0 - 1.0 / g.value) / length * straight + by_gauge * g.by_place;
  chain(placed, straight, by_straight, g, by_gauge, out);
  return out;
}

Residual ResidualsAt::solina_with_derivatives(Vec3 p) const {
  const Vec3 placed = local(p);
  const Vec3 straight = models::undeform(shape_, placed);
  const Gauge g = gauge_with_derivatives(straight);
  const double volume = std::sqrt(shape_.size_m.x * shape_.size_m.y * shape_.size_m.z);
  Residual out;
  out.value = volume * (g.value * g.value - 1.0);
  const double by_gauge = 2.0 * volume * g.value;
  chain(placed, straight, by_gauge * g.by_place, g, by_gauge, out);
  for (std::size_t k = 6; k < 9; ++k) out.by[k] += 0.5 * out.value;
  return out;
}

Columns ResidualsAt::nearest_on(std::span<const LineOfSight> sights) const {
  // The gauge is convex along a line (nearly so when bent). The zero of its slope is found by the Illinois
  // variant of false position, which halves the value at a retained end.
  const std::size_t n = sights.size();
  const double reach = models::reach_m(shape_);
  struct Line {
    double low, high, slope_low, slope_high, t;
    int stuck = 0;
  };
  std::vector<Line> lines(n);
  Columns places(n);
  RadialDistances distances;
  std::vector<double> slopes(n);
  const auto slopes_at = [&](auto&& parameter) {
    const double h = 1e-4 * reach;
    const auto look = [&](double beyond) {
      for (std::size_t i = 0; i < n; ++i)
        places.set(i, sights[i].origin_m + (parameter(lines[i]) + beyond) * sights[i].direction);
      radial_distances_of(places, distances);
    };
    if (shape_.deformed()) {
      look(-h);
      for (std::size_t i = 0; i < n; ++i) slopes[i] = -distances.radial[i];
      look(h);
      for (std::size_t i = 0; i < n; ++i) slopes[i] += distances.radial[i];
      return;
    }
    look(0.0);
    for (std::size_t i = 0; i < n; ++i)
      slopes[i] = dot(distances.outward.at(i),
                      transposed_times(shape_.scene_from_shape.rotation, sights[i].direction));
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double middle =
        dot(shape_.scene_from_shape.translation_m - sights[i].origin_m, sights[i].direction);
    lines[i] = {middle - reach, middle + reach, 0.0, 0.0, middle, 0};
  }
  slopes_at([](const Line& l) { return l.low; });
  for (std::size_t i = 0; i < n; ++i) lines[i].slope_low = std::min(slopes[i], -1e-12);
  slopes_at([](const Line& l) { return l.high; });
  for (std::size_t i = 0; i < n; ++i) lines[i].slope_high = std::max(slopes[i], 1e-12);
  constexpr int kLooks = 7;
  for (int k = 0; k < kLooks; ++k) {
    for (Line& l : lines) l.t = l.low - l.slope_low * (l.high - l.low) / (l.slope_high - l.slope_low);
    slopes_at([](const Line& l) { return l.t; });
    for (std::size_t i = 0; i < n; ++i) {
      Line& l = lines[i];
      const bool before = slopes[i] < 0.0;
      (before ? l.low : l.high) = l.t;
      (before ? l.slope_low : l.slope_high) = slopes[i];
      const int side = before ? 1 : 2;
      if (l.stuck == side) (before ? l.slope_high : l.slope_low) *= 0.5;
      l.stuck = side;
    }
  }
  for (std::size_t i = 0; i < n; ++i) places.set(i, sights[i].origin_m + lines[i].t * sights[i].direction);
  return places;
}

void ResidualsAt::radial_distances_of(const Columns& places, RadialDistances& out) const {
  Columns straight(places.count());
  for (std::size_t i = 0; i < places.count(); ++i) {
    const Vec3 placed = local(places.at(i));
    straight.set(i, shape_.deformed() ? models::undeform(shape_, placed) : placed);
  }
  out.resize(places.count());
  radial_distances(shape_, straight, out);
}

bool ResidualsAt::faces(Vec3 place, Vec3 outward, Vec3 eye) const {
  return dot(outward, transposed_times(shape_.scene_from_shape.rotation, eye - place)) > 0.0;
}

void ResidualsAt::radial_rows_of(const Columns& places, std::span<const double> weights, double* residuals,
                                 double* jacobian) const {
  if (count_ == kPlainParameters) {
    radial_rows({shape_, turned_, e1_rate_, e2_rate_}, places, weights, residuals, jacobian);
    return;
  }
  const std::size_t rows = places.count();
  for (std::size_t i = 0; i < rows; ++i) {
    if (jacobian == nullptr) {
      residuals[i] = weights[i] == 0.0 ? 0.0 : weights[i] * radial(places.at(i));
      continue;
    }
    const Residual r = weights[i] == 0.0 ? Residual{} : radial_with_derivatives(places.at(i));
    residuals[i] = weights[i] * r.value;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k)
      jacobian[k * rows + i] = weights[i] * r.by[k];
  }
}

}  // namespace palpable::sculpt
