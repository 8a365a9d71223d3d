// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/superquadric.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {
namespace {

// (u^p + v^p)^(1/p), computed relative to the larger term: exponents up to 20 would otherwise overflow or
// underflow.
struct Norm {
  double value = 0.0;
  double by_u = 0.0;
  double by_v = 0.0;
};

Norm power_norm(double u, double v, double p) noexcept {
  const double large = std::max(u, v);
  const double small = std::min(u, v);
  if (!(large > 0.0)) return {};
  const double ratio = small / large;
  const double powered = ratio > 0.0 ? std::pow(ratio, p) : 0.0;
  const double grown = std::pow(1.0 + powered, 1.0 / p);
  // d/d large = (1 + r^p)^(1/p - 1), d/d small = r^(p - 1) times that.
  const double by_large = grown / (1.0 + powered);
  const double by_small = ratio > 0.0 ? by_large * powered / ratio : 0.0;
  return u >= v ? Norm{large * grown, by_large, by_small} : Norm{large * grown, by_small, by_large};
}

double sign_of(double x) noexcept { return x < 0.0 ? -1.0 : 1.0; }

/// sin(x) / x.
double sinc(double x) noexcept { return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x; }

bool has_bend(const Superquadric& shape) noexcept { return shape.bend_per_m > 0.0; }

Vec3 bend(const Superquadric& shape, Vec3 p) noexcept {
  const double k = shape.bend_per_m;
  const double c = std::cos(shape.bend_angle_rad);
  const double s = std::sin(shape.bend_angle_rad);
  const double r = c * p.x + s * p.y;
  const double angle = k * p.z;
  const double half = p.z * sinc(0.5 * angle);
  // R - r = (1/k - r)(1 - cos(kz)), written so that k may be 0.
  const double towards = (1.0 - k * r) * 0.5 * k * half * half;
  return {p.x + c * towards, p.y + s * towards, (1.0 - k * r) * p.z * sinc(angle)};
}

Vec3 unbend(const Superquadric& shape, Vec3 p) noexcept {
  const double k = shape.bend_per_m;
  const double c = std::cos(shape.bend_angle_rad);
  const double s = std::sin(shape.bend_angle_rad);
  const double big = c * p.x + s * p.y;
  const double away = 1.0 - k * big;
  const double radius = std::hypot(k * p.z, away);
  // r = (1 - radius) / k, again without dividing by k.
  const double r = (2.0 * big - k * (big * big + p.z * p.z)) / (1.0 + radius);
  const double angle = std::atan2(k * p.z, away);
  // Below 1e-9 of a turn the arc equals its chord.
  const double z = std::abs(angle) > 1e-9 ? angle / k : p.z / std::max(away, 1e-9);
  return {p.x - c * (big - r), p.y - s * (big - r), z};
}

}  // namespace

Result<void> check_superquadric(const Superquadric& shape) {
  const auto sound_exponent = [](double e) { return e >= kLeastExponent && e <= kGreatestExponent; };
  const Vec3 a = shape.size_m;
  if (!is_finite(a) || !(a.x > 0.0 && a.y > 0.0 && a.z > 0.0))
    return invalid_input("a superquadric's half axes must be above 0");
  if (!sound_exponent(shape.e1) || !sound_exponent(shape.e2))
    return invalid_input("a superquadric's exponents must be 0.1 to 1.9");
  if (!(std::abs(shape.taper_x) < 1.0 && std::abs(shape.taper_y) < 1.0))
    return invalid_input("a superquadric's taper must be between -1 and 1");
  if (!(shape.bend_per_m >= 0.0) || !std::isfinite(shape.bend_angle_rad))
    return invalid_input("a superquadric's bend must be 0 or more");
  const Vec3 widest{a.x * (1.0 + std::abs(shape.taper_x)), a.y * (1.0 + std::abs(shape.taper_y)), 0.0};
  if (shape.bend_per_m * norm(widest) >= 1.0 || shape.bend_per_m * a.z >= 3.14)
    return invalid_input("a superquadric is bent so far that it would pass through itself");
  if (!is_finite(shape.scene_from_shape.translation_m))
    return invalid_input("a superquadric's position must be finite");
  return {};
}

double gauge(const Superquadric& shape, Vec3 p) noexcept {
  const double around =
      power_norm(std::abs(p.x) / shape.size_m.x, std::abs(p.y) / shape.size_m.y, 2.0 / shape.e2).value;
  return power_norm(around, std::abs(p.z) / shape.size_m.z, 2.0 / shape.e1).value;
}

double gauge(const Superquadric& shape, Vec3 p, Vec3& gradient_per_m) noexcept {
  const Vec3 a = shape.size_m;
  const Norm around = power_norm(std::abs(p.x) / a.x, std::abs(p.y) / a.y, 2.0 / shape.e2);
  const Norm whole = power_norm(around.value, std::abs(p.z) / a.z, 2.0 / shape.e1);
  gradient_per_m = {sign_of(p.x) * whole.by_u * around.by_u / a.x,
                    sign_of(p.y) * whole.by_u * around.by_v / a.y, sign_of(p.z) * whole.by_v / a.z};
  return whole.value;
}

double inside_outside(const Superquadric& shape, Point<SceneFrame> p) noexcept {
  const double g = gauge(shape, undeform(shape, (shape.scene_from_shape.inverse() * p).v));
  return g * g;
}

Vec3 deform(const Superquadric& shape, Vec3 p) noexcept {
  const double along = std::clamp(p.z / shape.size_m.z, -1.0, 1.0);
  const Vec3 tapered{(shape.taper_x * along + 1.0) * p.x, (shape.taper_y * along + 1.0) * p.y, p.z};
  return has_bend(shape) ? bend(shape, tapered) : tapered;
}

Vec3 undeform(const Superquadric& shape, Vec3 p) noexcept {
  const Vec3 straight = has_bend(shape) ? unbend(shape, p) : p;
  const double along = std::clamp(straight.z / shape.size_m.z, -1.0, 1.0);
  return {straight.x / (shape.taper_x * along + 1.0), straight.y / (shape.taper_y * along + 1.0), straight.z};
}

DeformedPoint deform_with_jacobian(const Superquadric& shape, Vec3 p) noexcept {
  const double along = std::clamp(p.z / shape.size_m.z, -1.0, 1.0);
  const double inner = std::abs(p.z) < shape.size_m.z ? 1.0 / shape.size_m.z : 0.0;
  const double fx = shape.taper_x * along + 1.0;
  const double fy = shape.taper_y * along + 1.0;
  const Vec3 tapered{fx * p.x, fy * p.y, p.z};
  DeformedPoint out{tapered,
                    {fx, 0.0, 0.0},
                    {0.0, fy, 0.0},
                    {shape.taper_x * inner * p.x, shape.taper_y * inner * p.y, 1.0}};
  if (!has_bend(shape)) return out;
  const double k = shape.bend_per_m;
  const double c = std::cos(shape.bend_angle_rad);
  const double s = std::sin(shape.bend_angle_rad);
  const double angle = k * p.z;
  const double stretch = 1.0 - k * (c * tapered.x + s * tapered.y);
  const double half = p.z * sinc(0.5 * angle);
  const double arc = 0.5 * k * half * half;  // (1 - cos(kz)) / k
  const double chord = p.z * sinc(angle);    // sin(kz) / k
  out.place = {tapered.x + c * stretch * arc, tapered.y + s * stretch * arc, stretch * chord};
  const auto turned = [&](Vec3 d) {
    const double dr = c * d.x + s * d.y;
    const double towards = stretch * std::sin(angle) * d.z - k * arc * dr;
    return Vec3{d.x + c * towards, d.y + s * towards, stretch * std::cos(angle) * d.z - k * chord * dr};
  };
  out.by_x = turned(out.by_x);
  out.by_y = turned(out.by_y);
  out.by_z = turned(out.by_z);
  return out;
}

Vec3 on_surface(const Superquadric& shape, Vec3 p) noexcept { return p / gauge(shape, p); }

double reach_m(const Superquadric& shape) noexcept {
  const Vec3 a = shape.size_m;
  return norm({a.x * (1.0 + std::abs(shape.taper_x)), a.y * (1.0 + std::abs(shape.taper_y)), a.z});
}

std::array<double, 4> quaternion_of(const std::array<double, 9>& r) noexcept {
  // Shepperd's method: divide by the largest of the four.
  std::array<double, 4> q{1.0 + r[0] + r[4] + r[8], 1.0 + r[0] - r[4] - r[8], 1.0 - r[0] + r[4] - r[8],
                          1.0 - r[0] - r[4] + r[8]};
  const std::array<double, 3> odd{r[7] - r[5], r[2] - r[6], r[3] - r[1]};
  const std::array<double, 3> even{r[3] + r[1], r[2] + r[6], r[7] + r[5]};
  const auto most = static_cast<std::size_t>(std::max_element(q.begin(), q.end()) - q.begin());
  if (most == 0) q = {q[0], odd[0], odd[1], odd[2]};
  if (most == 1) q = {odd[0], q[1], even[0], even[1]};
  if (most == 2) q = {odd[1], even[0], q[2], even[2]};
  if (most == 3) q = {odd[2], even[1], even[2], q[3]};
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double scale = (q[0] < 0.0 ? -1.0 : 1.0) / length;
  for (double& part : q) part *= scale;
  return q;
}

std::array<double, 9> rotation_of(const std::array<double, 4>& q) noexcept {
  const auto [w, x, y, z] = q;
  return {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z),       2.0 * (x * z + w * y),
          2.0 * (x * y + w * z),       1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),
          2.0 * (x * z - w * y),       2.0 * (y * z + w * x),       1.0 - 2.0 * (x * x + y * y)};
}

}  // namespace palpable::models
