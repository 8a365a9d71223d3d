// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/superquadric_distance.hpp"

#include "palpable/models/field/superquadric_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palpable::models {
namespace {

constexpr double kHalfPi = 1.57079632679489662;
constexpr double kLeastAngle = 1e-9;
constexpr int kMostSteps = 60;

/// One of the surface's two angles: cos^e and sin^e with their derivatives by phi. With tan^m(eta) =
/// tan(phi), m = min(e, 2 - e), the derivatives of point and normal by phi are bounded for every exponent
/// from 0.1 to 1.9; those by eta are not.
struct Curve {
  double c, s;                // cos^e(eta), sin^e(eta)
  double dc, ds;              // by phi
  double ddc, dds;            // by phi twice
  double normal_c, normal_s;  // cos^(2-e), sin^(2-e)
};

Curve curve_at(double phi, double e) noexcept {
  const double m = std::min(e, 2.0 - e);
  const double u = std::log(std::tan(phi)) / m;  // ln tan(eta)
  const double grown = std::exp(2.0 * u);
  const double c2 = 1.0 / (1.0 + grown);
  const double s2 = grown > 1e300 ? 1.0 : grown * c2;
  const double log_c = -0.5 * (u > 300.0 ? 2.0 * u : std::log1p(grown));
  const double log_s = log_c + u;
  Curve k{};
  k.c = std::exp(e * log_c);
  k.s = std::exp(e * log_s);
  k.normal_c = std::exp((2.0 - e) * log_c);
  k.normal_s = std::exp((2.0 - e) * log_s);
  // By u: (cos^e)' = -e sin^2 cos^e, (sin^e)' = e cos^2 sin^e.
  const double uc = -e * s2 * k.c;
  const double us = e * c2 * k.s;
  const double uuc = e * s2 * k.c * (e * s2 - 2.0 * c2);
  const double uus = e * c2 * k.s * (e * c2 - 2.0 * s2);
  const double pace = m * std::sin(phi) * std::cos(phi);  // d phi / d u
  const double turn = m * std::cos(2.0 * phi);
  k.dc = uc / pace;
  k.ds = us / pace;
  k.ddc = (uuc - uc * turn) / (pace * pace);
  k.dds = (uus - us * turn) / (pace * pace);
  return k;
}

/// Half the squared distance of x to the surface's point at two angles, with its derivatives.
struct Objective {
  double value = 0.0;
  std::array<double, 2> gradient{};
  std::array<double, 3> hessian{};  // 00, 01, 11
  Vec3 place, normal;
};

Objective objective_at(const Superquadric& shape, Vec3 x, double phi, double psi) noexcept {
  const Vec3 a = shape.size_m;
  const Curve h = curve_at(phi, shape.e1);
  const Curve w = curve_at(psi, shape.e2);
  Objective o;
  o.place = {a.x * h.c * w.c, a.y * h.c * w.s, a.z * h.s};
  o.normal = {h.normal_c * w.normal_c / a.x, h.normal_c * w.normal_s / a.y, h.normal_s / a.z};
  const Vec3 off = o.place - x;
  const Vec3 by_phi{a.x * h.dc * w.c, a.y * h.dc * w.s, a.z * h.ds};
  const Vec3 by_psi{a.x * h.c * w.dc, a.y * h.c * w.ds, 0.0};
  o.value = 0.5 * squared_norm(off);
  o.gradient = {dot(off, by_phi), dot(off, by_psi)};
  o.hessian = {squared_norm(by_phi) + dot(off, {a.x * h.ddc * w.c, a.y * h.ddc * w.s, a.z * h.dds}),
               dot(by_phi, by_psi) + dot(off, {a.x * h.dc * w.dc, a.y * h.dc * w.ds, 0.0}),
               squared_norm(by_psi) + dot(off, {a.x * h.c * w.ddc, a.y * h.c * w.dds, 0.0})};
  return o;
}

/// Newton's step with the absolute eigenvalues of the Hessian, so that it is always a descent direction.
std::array<double, 2> newton_step(std::array<double, 2> g, std::array<double, 3> h) noexcept {
  const double mean = 0.5 * (h[0] + h[2]);
  const double half = std::hypot(0.5 * (h[0] - h[2]), h[1]);
  const double floor = 1e-12 * (std::abs(mean) + half) + 1e-300;
  const double large = std::max(std::abs(mean + half), floor);
  const double small = std::max(std::abs(mean - half), floor);
  const double angle = half > 0.0 ? 0.5 * std::atan2(h[1], 0.5 * (h[0] - h[2])) : 0.0;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double along = -(c * g[0] + s * g[1]) / large;
  const double across = -(-s * g[0] + c * g[1]) / small;
  return {c * along - s * across, s * along + c * across};
}

double held(double angle) noexcept { return std::clamp(angle, kLeastAngle, kHalfPi - kLeastAngle); }

/// Keeps an angle fixed that is at its bound.
void rest_at_bounds(std::array<double, 2> at, Objective& o) noexcept {
  for (std::size_t i = 0; i < 2; ++i) {
    const bool low = at[i] <= kLeastAngle && o.gradient[i] > 0.0;
    const bool high = at[i] >= kHalfPi - kLeastAngle && o.gradient[i] < 0.0;
    if (!low && !high) continue;
    o.gradient[i] = 0.0;
    o.hessian[1] = 0.0;
    o.hessian[i == 0 ? 0 : 2] = 1.0;
  }
}

/// A local minimum of the distance in the octant, from a starting point.
Objective descend(const Superquadric& shape, Vec3 x, std::array<double, 2> at) noexcept {
  constexpr double kLongestStep = 0.5;
  constexpr double kShortestStep = 1e-13;
  Objective here = objective_at(shape, x, at[0], at[1]);
  for (int k = 0; k < kMostSteps; ++k) {
    Objective bounded = here;
    rest_at_bounds(at, bounded);
    std::array<double, 2> step = newton_step(bounded.gradient, bounded.hessian);
    const double length = std::hypot(step[0], step[1]);
    if (length < kShortestStep) break;
    double share = std::min(1.0, kLongestStep / length);
    bool moved = false;
    for (; share * length >= kShortestStep; share *= 0.4) {
      const std::array<double, 2> next{held(at[0] + share * step[0]), held(at[1] + share * step[1])};
      const Objective there = objective_at(shape, x, next[0], next[1]);
      if (there.value < here.value) {
        at = next;
        here = there;
        moved = true;
        break;
      }
    }
    if (!moved) break;
  }
  return here;
}

/// The angles of the surface's point on the ray through `p`, all coordinates >= 0.
std::array<double, 2> angles_of(const Superquadric& shape, Vec3 p) noexcept {
  const auto angle = [](double s, double c, double e) {
    // tan(phi) = tan^m(eta), and tan^e(eta) = s / c.
    const double m = std::min(e, 2.0 - e);
    return held(std::atan(std::pow(s / std::max(c, 1e-300), m / e)));
  };
  const double u = p.x / shape.size_m.x;
  const double v = p.y / shape.size_m.y;
  const double w = p.z / shape.size_m.z;
  const double around = gauge(shape, {p.x, p.y, 0.0});
  if (around == 0.0 && w == 0.0) return {0.5 * kHalfPi, 0.5 * kHalfPi};
  return {angle(w, around, shape.e1), u == 0.0 && v == 0.0 ? 0.5 * kHalfPi : angle(v, u, shape.e2)};
}

/// The intersection of a ray from inside, along an axis, with the surface.
Vec3 hit_along(const Superquadric& shape, Vec3 p, std::size_t axis) noexcept {
  const Vec3 a = shape.size_m;
  const double ez = 2.0 / shape.e1;
  const double ex = 2.0 / shape.e2;
  const double around = gauge(shape, {p.x, p.y, 0.0});
  if (axis == 2) return {p.x, p.y, a.z * std::pow(std::max(0.0, 1.0 - std::pow(around, ez)), 1.0 / ez)};
  const double room = std::pow(std::max(0.0, 1.0 - std::pow(p.z / a.z, ez)), 1.0 / ez);
  const double other = axis == 0 ? p.y / a.y : p.x / a.x;
  const double reach = std::pow(std::max(0.0, std::pow(room, ex) - std::pow(other, ex)), 1.0 / ex);
  return axis == 0 ? Vec3{a.x * reach, p.y, p.z} : Vec3{p.x, a.y * reach, p.z};
}

double with_sign(double magnitude, double like) noexcept { return like < 0.0 ? -magnitude : magnitude; }

using Local = SuperquadricDistance::Local;

Local nearest_straight(const Superquadric& shape, Vec3 p) noexcept {
  const Vec3 x{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
  const bool inside = gauge(shape, x) < 1.0;
  Objective best = descend(shape, x, angles_of(shape, x));
  // Inside a convex body each face may have its own local minimum.
  if (inside)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Objective other = descend(shape, x, angles_of(shape, hit_along(shape, x, axis)));
      if (other.value < best.value) best = other;
    }
  const double distance = std::sqrt(2.0 * best.value);
  const Vec3 n = unit(best.normal);
  return {{with_sign(best.place.x, p.x), with_sign(best.place.y, p.y), with_sign(best.place.z, p.z)},
          {with_sign(n.x, p.x), with_sign(n.y, p.y), with_sign(n.z, p.z)},
          inside ? -distance : distance};
}

/// Moves on the undeformed surface: a step in the tangent plane, then projection along the ray from the
/// centre.
struct Walk {
  const Superquadric& shape;
  Vec3 x;
  Vec3 at;             // on the undeformed surface
  Vec3 first, second;  // tangents there
  double value = 0.0;

  double value_at(Vec3 straight) const noexcept { return 0.5 * squared_norm(deform(shape, straight) - x); }

  void settle(Vec3 straight) noexcept {
    at = straight;
    value = value_at(straight);
    Vec3 g;
    gauge(shape, at, g);
    const Vec3 n = unit(g);
    const Vec3 helper = std::abs(n.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    first = unit(cross(n, helper));
    second = cross(n, first);
  }

  Vec3 stepped(double a, double b) const noexcept { return on_surface(shape, at + a * first + b * second); }

  std::array<double, 2> gradient_at(double a, double b) const noexcept {
    const Vec3 flat = at + a * first + b * second;
    Vec3 g;
    const double size = gauge(shape, flat, g);
    const Vec3 on = flat / size;
    const DeformedPoint d = deform_with_jacobian(shape, on);
    const Vec3 off = d.place - x;
    const auto along = [&](Vec3 t) {
      const Vec3 moved = (t - dot(g, t) * on) / size;
      return dot(off, moved.x * d.by_x + moved.y * d.by_y + moved.z * d.by_z);
    };
    return {along(first), along(second)};
  }
};

void descend(Walk& walk, double reach) noexcept {
  constexpr double kSettled = 1e-7;
  const double h = 1e-6 * reach;
  for (int k = 0; k < kMostSteps; ++k) {
    const auto g = walk.gradient_at(0.0, 0.0);
    const auto gx = walk.gradient_at(h, 0.0);
    const auto gy = walk.gradient_at(0.0, h);
    const std::array<double, 3> hessian{(gx[0] - g[0]) / h, 0.5 * (gx[1] - g[1] + gy[0] - g[0]) / h,
                                        (gy[1] - g[1]) / h};
    const auto step = newton_step(g, hessian);
    const double length = std::hypot(step[0], step[1]);
    // The distance's error is quadratic in the remaining step.
    if (length < kSettled * reach) return;
    bool moved = false;
    for (double share = std::min(1.0, 0.3 * reach / length); share * length > kSettled * reach;
         share *= 0.4) {
      const Vec3 next = walk.stepped(share * step[0], share * step[1]);
      if (!(walk.value_at(next) < walk.value)) continue;
      walk.settle(next);
      moved = true;
      break;
    }
    if (!moved) return;
  }
}

}  // namespace

Result<SuperquadricDistance> SuperquadricDistance::from(const Superquadric& shape) {
  if (auto valid = check_superquadric(shape); !valid) return std::move(valid).error();
  return SuperquadricDistance(shape);
}

namespace {

/// The point of the undeformed surface for a point on one side of its bounding box, u and v from -1 to 1.
Vec3 place_on_side(const Superquadric& shape, std::size_t side, double u, double v) noexcept {
  const double sign = side % 2 == 0 ? -1.0 : 1.0;
  const Vec3 a = shape.size_m;
  const Vec3 cube = side / 2 == 0 ? Vec3{sign, u, v} : side / 2 == 1 ? Vec3{v, sign, u} : Vec3{u, v, sign};
  return on_surface(shape, {a.x * cube.x, a.y * cube.y, a.z * cube.z});
}

constexpr int kSamplesOnSide = 12;

}  // namespace

SuperquadricDistance::SuperquadricDistance(const Superquadric& shape)
    : shape_(shape), shape_from_scene_(shape.scene_from_shape.inverse()), reach_m_(models::reach_m(shape)) {
  if (!shape_.deformed()) return;
  // A bent shape is curved about a centre that may be near.
  reach_m_ = 0.0;
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t first = seeds_.size();
    for (int i = 0; i < kSamplesOnSide; ++i)
      for (int j = 0; j < kSamplesOnSide; ++j) {
        const Vec3 straight = place_on_side(shape_, side, 2.0 * (i + 0.5) / kSamplesOnSide - 1.0,
                                            2.0 * (j + 0.5) / kSamplesOnSide - 1.0);
        seeds_.push_back({straight, deform(shape_, straight)});
      }
    // Points between the seeds, including the edges of the sides.
    constexpr int kFiner = 2 * kSamplesOnSide;
    for (int i = 0; i <= kFiner; ++i)
      for (int j = 0; j <= kFiner; ++j) {
        const Vec3 place =
            deform(shape_, place_on_side(shape_, side, 2.0 * i / kFiner - 1.0, 2.0 * j / kFiner - 1.0));
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = first; k < seeds_.size(); ++k)
          least = std::min(least, squared_norm(seeds_[k].place - place));
        gaps_m_[side] = std::max(gaps_m_[side], std::sqrt(least));
        reach_m_ = std::max(reach_m_, norm(place));
      }
    constexpr double kBetween = 1.1;
    gaps_m_[side] *= kBetween;
  }
  reach_m_ += *std::max_element(gaps_m_.begin(), gaps_m_.end());
}

double SuperquadricDistance::least_distance_m(Point<SceneFrame> p) const noexcept {
  return norm(p.v - shape_.scene_from_shape.translation_m) - reach_m_;
}

SuperquadricDistance::Local SuperquadricDistance::nearest_deformed(Vec3 x) const noexcept {
  constexpr std::size_t kPart = std::size_t{kSamplesOnSide} * kSamplesOnSide;
  std::array<std::pair<double, std::size_t>, 6> sides;
  for (std::size_t side = 0; side < 6; ++side) {
    const auto begin = seeds_.begin() + static_cast<std::ptrdiff_t>(side * kPart);
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kPart; ++k) {
      const double squared = squared_norm(begin[static_cast<std::ptrdiff_t>(k)].place - x);
      if (squared < least) least = squared, nearest = side * kPart + k;
    }
    sides[side] = {std::sqrt(least), nearest};
  }
  std::sort(sides.begin(), sides.end());
  Local best;
  for (const auto& [seed_m, seed] : sides) {
    // No point of that side can be nearer.
    if (seed_m - gaps_m_[seed / kPart] >= best.distance_m) continue;
    Walk walk{shape_, x, {}, {}, {}, 0.0};
    walk.settle(seeds_[seed].straight);
    descend(walk, reach_m_);
    const double distance_m = std::sqrt(2.0 * walk.value);
    if (distance_m >= best.distance_m) continue;
    best = {deform(shape_, walk.at), surface_normal(shape_, walk.at), distance_m};
  }
  if (gauge(shape_, undeform(shape_, x)) < 1.0) best.distance_m = -best.distance_m;
  return best;
}

ClosestPoint SuperquadricDistance::closest_point(Point<SceneFrame> p) const noexcept {
  const Vec3 x = (shape_from_scene_ * p).v;
  const Local best = seeds_.empty() ? nearest_straight(shape_, x) : nearest_deformed(x);
  return {shape_.scene_from_shape * Point<ShapeFrame>{best.place}, best.distance_m,
          Vector<SceneFrame>{shape_.scene_from_shape.rotate(best.normal)}};
}

ClosestPoint closest_point(const std::vector<SuperquadricDistance>& shapes, Point<SceneFrame> p) noexcept {
  ClosestPoint best{p, std::numeric_limits<double>::infinity(), {}};
  for (const SuperquadricDistance& shape : shapes) {
    if (shape.least_distance_m(p) >= best.distance_m) continue;
    const ClosestPoint here = shape.closest_point(p);
    if (here.distance_m < best.distance_m) best = here;
  }
  return best;
}

}  // namespace palpable::models
