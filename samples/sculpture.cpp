// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "sculpture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace palpable::samples {
namespace {

// Signed distances (metres, negative inside) of simple solids, and smooth ways to join them.

double length2(double x, double y) { return std::sqrt(x * x + y * y); }

double sphere(Vec3 p, Vec3 centre, double radius) { return norm(p - centre) - radius; }

/// A lower bound of the distance, not the exact distance; close to it near the surface if the radii are
/// similar.
double ellipsoid(Vec3 p, Vec3 centre, Vec3 radii) {
  const Vec3 q = p - centre;
  const double k0 = norm({q.x / radii.x, q.y / radii.y, q.z / radii.z});
  const double k1 = norm({q.x / (radii.x * radii.x), q.y / (radii.y * radii.y), q.z / (radii.z * radii.z)});
  return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min({radii.x, radii.y, radii.z});
}

double box(Vec3 p, Vec3 centre, Vec3 half, double rounding) {
  const Vec3 q{std::abs(p.x - centre.x) - half.x + rounding, std::abs(p.y - centre.y) - half.y + rounding,
               std::abs(p.z - centre.z) - half.z + rounding};
  const Vec3 outside{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return norm(outside) + std::min(std::max({q.x, q.y, q.z}), 0.0) - rounding;
}

/// A rod with round ends whose radius changes linearly.
double rod(Vec3 p, Vec3 a, Vec3 b, double radius_a, double radius_b) {
  const Vec3 along = b - a;
  const double t = std::clamp(dot(p - a, along) / squared_norm(along), 0.0, 1.0);
  return norm(p - a - t * along) - (radius_a + t * (radius_b - radius_a));
}

double ring(Vec3 p, Vec3 centre, double radius, double thickness) {
  const Vec3 q = p - centre;
  return length2(length2(q.x, q.y) - radius, q.z) - thickness;
}

/// The union with a fillet of about `width`.
double joined(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width * 0.25;
}

/// `a` without `b`, with a fillet.
double carved(double a, double b, double width) { return -joined(-a, b, width); }

double head(Vec3 p) {
  const Vec3 m{std::abs(p.x), p.y, p.z};  // faces are symmetric
  double d = ellipsoid(m, {0, 0.012, 0.0}, {0.062, 0.078, 0.052});
  d = joined(d, ellipsoid(m, {0, -0.048, 0.004}, {0.040, 0.040, 0.042}), 0.030);
  d = joined(d, ellipsoid(m, {0.034, -0.012, 0.022}, {0.022, 0.024, 0.022}), 0.020);
  d = carved(d, ellipsoid(m, {0.0255, 0.018, 0.052}, {0.018, 0.012, 0.014}), 0.012);
  d = joined(d, ellipsoid(m, {0.0255, 0.017, 0.0385}, {0.0125, 0.0085, 0.0085}), 0.002);
  d = joined(d, rod(m, {0.010, 0.0315, 0.0515}, {0.042, 0.030, 0.0385}, 0.0055, 0.004), 0.010);
  d = joined(d, rod(m, {0, 0.026, 0.050}, {0, -0.008, 0.066}, 0.0055, 0.0080), 0.008);
  d = joined(d, sphere(m, {0.0095, -0.0105, 0.0545}, 0.0062), 0.006);
  d = carved(d, ellipsoid(m, {0, -0.0365, 0.0560}, {0.021, 0.0022, 0.010}), 0.003);
  d = joined(d, rod(m, {0, -0.0315, 0.0490}, {0.017, -0.0350, 0.0425}, 0.0048, 0.0025), 0.004);
  d = joined(d, rod(m, {0, -0.0425, 0.0480}, {0.015, -0.0385, 0.0425}, 0.0056, 0.0028), 0.004);
  d = joined(d, sphere(m, {0, -0.066, 0.036}, 0.014), 0.016);
  d = joined(d, ellipsoid(m, {0.064, 0.006, 0.004}, {0.008, 0.020, 0.014}), 0.006);
  return d;
}

double bowl(Vec3 p) {
  constexpr double kRadius = 0.056;
  constexpr double kThickness = 0.0035;
  constexpr double kRim = 0.046;
  const Vec3 q = p - Vec3{0, 0, kRadius};
  const double shell = std::abs(norm(q) - (kRadius - kThickness)) - kThickness;
  return -joined(-shell, -(p.z - kRim), 0.003);
}

double stairs(Vec3 p) {
  double d = std::numeric_limits<double>::max();
  for (int step = 0; step < 4; ++step) {
    const double height = 0.013 * (step + 1);
    const double left = -0.066 + 0.033 * step;
    d = std::min(d, box(p, {0.5 * (left + 0.066), 0, 0.5 * height},
                        {0.5 * (0.066 - left), 0.030, 0.5 * height}, 0.001));
  }
  return d;
}

/// A plate with a raised letter P.
double letter(Vec3 p) {
  const double plate = box(p, {0, 0, 0.004}, {0.040, 0.038, 0.004}, 0.002);
  const double stem = box(p, {-0.015, 0, 0.009}, {0.0055, 0.028, 0.009}, 0.0015);
  const Vec3 q = p - Vec3{-0.006, 0.012, 0.009};
  const double outline = std::abs(length2(std::max(q.x, 0.0), q.y) - 0.0125) - 0.0045;
  const double bow = std::max({outline, std::abs(q.z) - 0.009, -q.x - 0.009});
  return std::min({plate, stem, bow});
}

double pyramid(Vec3 p) {
  const double side = std::max(std::abs(p.x), std::abs(p.y));
  return std::max((side + 0.75 * (p.z - 0.052)) * 0.8, -p.z);
}

Vec3 turned(Vec3 p, double cosine, double sine) {
  return {cosine * p.x + sine * p.y, -sine * p.x + cosine * p.y, p.z};
}

enum Thing : std::size_t { kTable, kHead, kBall, kCube, kBowl, kRing, kStairs, kLetter, kPyramid, kThings };

struct Place {
  Vec3 at;
  /// Radius of a bounding ball of the object, centred at `at` raised by half of the radius.
  double reach;
};
constexpr std::array<Place, kThings> kPlaces{{{{0, 0, 0}, 0},
                                              {{0, -0.010, 0.002}, 0.115},
                                              {{-0.175, 0.105, 0}, 0.085},
                                              {{0.175, 0.100, 0}, 0.085},
                                              {{-0.165, -0.090, 0}, 0.080},
                                              {{0.165, -0.020, 0}, 0.070},
                                              {{-0.010, -0.155, 0}, 0.085},
                                              {{0, 0.140, 0}, 0.065},
                                              {{0.165, -0.135, 0}, 0.080}}};

double distance_to(Thing thing, Vec3 p) {
  const Vec3 q = p - kPlaces[thing].at;
  switch (thing) {
    case kTable:
      return p.z;
    case kHead:
      return head(q);
    case kBall:
      return sphere(q, {0, 0, 0.042}, 0.042);
    case kCube:
      return box(turned(q, 0.8, 0.6), {0, 0, 0.033}, {0.033, 0.033, 0.033}, 0.003);
    case kBowl:
      return bowl(q);
    case kRing:
      return ring(q, {0, 0, 0.015}, 0.040, 0.015);
    case kStairs:
      return stairs(q);
    case kLetter:
      return letter(q);
    case kPyramid:
      return pyramid(q);
    case kThings:
      break;
  }
  return std::numeric_limits<double>::max();
}

struct Nearest {
  double distance;
  Thing thing;
};

Nearest nearest(Vec3 p) {
  Nearest best{p.z, kTable};
  for (std::size_t i = 1; i < kThings; ++i) {
    const Place& place = kPlaces[i];
    // Outside its ball, the distance to an object is at least this: enough for a step of the ray.
    const double bound = norm(p - place.at) - place.reach;
    if (bound > best.distance) continue;
    const double d = bound > 0.02 ? bound : distance_to(static_cast<Thing>(i), p);
    if (d < best.distance) best = {d, static_cast<Thing>(i)};
  }
  return best;
}

Vec3 normal_at(Vec3 p) {
  constexpr double kStep = 1e-5;
  const auto difference = [&](Vec3 e) { return nearest(p + e).distance - nearest(p - e).distance; };
  return unit({difference({kStep, 0, 0}), difference({0, kStep, 0}), difference({0, 0, kStep})});
}

/// Length along a ray to the first surface. Every ray ends at the table or before it. Steps are shortened,
/// since the joined distances may slightly exceed the true ones; a bisection at the end makes the result
/// exact.
double meet(Vec3 from, Vec3 direction) {
  double t = 0.0;
  double before = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double d = nearest(from + t * direction).distance;
    if (d < 1e-9) break;
    before = t;
    t += 0.8 * d;
    if (d < 1e-6) t += 1e-6;
  }
  for (int i = 0; i < 40 && t - before > 1e-9; ++i) {
    const double middle = 0.5 * (before + t);
    (nearest(from + middle * direction).distance > 0.0 ? before : t) = middle;
  }
  return t;
}

/// 1 in light, 0 in shadow, between them in the penumbra.
double light_reaching(Vec3 p, Vec3 to_light) {
  double most = 1.0;
  double t = 0.002;
  for (int i = 0; i < 40 && t < 0.25; ++i) {
    const double d = nearest(p + t * to_light).distance;
    most = std::min(most, 9.0 * d / t);
    if (most <= 0.0) return 0.0;
    t += std::clamp(d, 0.0015, 0.03);
  }
  return most * most * (3.0 - 2.0 * most);
}

/// Ambient light: less of it reaches creases.
double openness(Vec3 p, Vec3 n) {
  double closed = 0.0;
  double weight = 1.0;
  for (int i = 1; i <= 4; ++i) {
    const double h = 0.006 * i;
    closed += weight * (h - nearest(p + h * n).distance);
    weight *= 0.6;
  }
  return std::clamp(1.0 - 14.0 * closed, 0.25, 1.0);
}

// Solid textures from hashed lattice noise: fine grain for stereo matching, coarser patterns for the
// appearance.

double lattice(std::int64_t x, std::int64_t y, std::int64_t z) {
  auto h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL +
           static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL +
           static_cast<std::uint64_t>(z) * 0x165667B19E3779F9ULL;
  h ^= h >> 31U;
  h *= 0xBF58476D1CE4E5B9ULL;
  h ^= h >> 29U;
  return static_cast<double>(h >> 40U) / static_cast<double>(1U << 24U);
}

double noise(Vec3 p) {
  const Vec3 f{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double u = ease(p.x - f.x);
  const double v = ease(p.y - f.y);
  const double w = ease(p.z - f.z);
  const auto x = static_cast<std::int64_t>(f.x);
  const auto y = static_cast<std::int64_t>(f.y);
  const auto z = static_cast<std::int64_t>(f.z);
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  const auto row = [&](std::int64_t dy, std::int64_t dz) {
    return mix(lattice(x, y + dy, z + dz), lattice(x + 1, y + dy, z + dz), u);
  };
  return mix(mix(row(0, 0), row(1, 0), v), mix(row(0, 1), row(1, 1), v), w);
}

double grain(Vec3 p) { return 0.5 * noise(700.0 * p) + 0.3 * noise(330.0 * p) + 0.2 * noise(150.0 * p); }

Vec3 mixed(Vec3 a, Vec3 b, double t) { return a + std::clamp(t, 0.0, 1.0) * (b - a); }

Vec3 wood(Vec3 p) {
  const double along = noise({6.0 * p.x, 60.0 * p.y, 9.0});
  const double fibre = noise({45.0 * p.x, 900.0 * p.y, 2.0});
  const double plank = p.y / 0.082 + 40.0;
  const double seam = std::abs(plank - std::floor(plank) - 0.5);
  const double tone = 0.25 * lattice(static_cast<std::int64_t>(std::floor(plank)), 5, 5);
  const Vec3 colour = mixed({0.20, 0.105, 0.05}, {0.50, 0.30, 0.16}, 0.45 * along + 0.4 * fibre + tone);
  return (seam > 0.488 ? 0.45 : 1.0) * colour;
}

Vec3 marble(Vec3 p, Vec3 light, Vec3 vein) {
  const double bend = noise(38.0 * p) + 0.5 * noise(85.0 * p);
  const double wave = 22.0 * (p.x + 0.6 * p.y + 0.4 * p.z) + 2.2 * bend + 100.0;
  const double ridge = std::abs(2.0 * (wave - std::floor(wave)) - 1.0);
  return mixed(light, vein, ridge * ridge * ridge * ridge * 0.8);
}

Vec3 colour_of(Thing thing, Vec3 p) {
  const Vec3 q = p - kPlaces[thing].at;
  const double rough = grain(p);
  switch (thing) {
    case kTable:
      return wood(p) * (0.7 + 0.6 * rough);
    case kHead:
      return marble(q, {0.86, 0.80, 0.72}, {0.42, 0.36, 0.33}) * (0.62 + 0.76 * rough);
    case kBall:
      return mixed({0.62, 0.10, 0.07}, {0.95, 0.62, 0.20}, noise(80.0 * q) * 1.6 - 0.3) * (0.6 + 0.8 * rough);
    case kCube:
      return mixed({0.10, 0.25, 0.50}, {0.45, 0.70, 0.85}, noise(110.0 * q) * 1.6 - 0.3) *
             (0.6 + 0.8 * rough);
    case kBowl:
      return mixed({0.08, 0.30, 0.26}, {0.55, 0.78, 0.62}, noise(95.0 * q) * 1.6 - 0.3) * (0.6 + 0.8 * rough);
    case kRing:
      return mixed({0.55, 0.38, 0.08}, {0.95, 0.82, 0.40}, noise(130.0 * q) * 1.5 - 0.2) *
             (0.6 + 0.8 * rough);
    case kStairs:
      return marble(q, {0.62, 0.62, 0.66}, {0.22, 0.22, 0.27}) * (0.55 + 0.9 * rough);
    case kLetter:
      return mixed({0.75, 0.68, 0.52}, {0.45, 0.33, 0.20}, noise(120.0 * q)) * (0.6 + 0.8 * rough);
    case kPyramid:
      return mixed({0.42, 0.20, 0.46}, {0.80, 0.56, 0.72}, noise(100.0 * q) * 1.6 - 0.3) *
             (0.6 + 0.8 * rough);
    case kThings:
      break;
  }
  return {};
}

Vec3 shade(Vec3 from, Vec3 direction) {
  const Vec3 p = from + meet(from, direction) * direction;
  const Vec3 n = normal_at(p);
  const Vec3 to_light = unit({-0.55, 0.62, 0.85});
  const double direct = std::max(dot(n, to_light), 0.0);
  const double lit = direct > 0.0 ? direct * light_reaching(p + 2e-4 * n, to_light) : 0.0;
  const double sky = openness(p, n) * (0.6 + 0.4 * n.z);
  const Vec3 colour = colour_of(nearest(p).thing, p);
  const Vec3 light = lit * Vec3{0.98, 0.92, 0.80} + sky * Vec3{0.30, 0.33, 0.38};
  return {colour.x * light.x, colour.y * light.y, colour.z * light.z};
}

Vec3 direction_through(const View& view, double x, double y) {
  const Pinhole& c = view.rig.left;
  return (x - c.cx) / c.fx * view.right + (y - c.cy) / c.fy * view.down + view.forward;
}

/// A square root is close to the transfer curve of sRGB, and gives the same rounding on every machine.
std::uint8_t encoded(double linear) {
  return static_cast<std::uint8_t>(std::floor(255.0 * std::sqrt(std::clamp(linear, 0.0, 1.0)) + 0.5));
}

}  // namespace

View sculpture_view() {
  View view;
  constexpr int kWidth = 640;
  constexpr int kHeight = 480;
  view.rig = {{760.0, 760.0, 319.5, 239.5, kWidth, kHeight}, 0.05, 0.0};
  // The camera looks down at the table at an angle of 16.26 degrees, whose sine and cosine come from a
  // Pythagorean triple.
  constexpr double kSine = 7.0 / 25.0;
  constexpr double kCosine = 24.0 / 25.0;
  constexpr double kDistance_m = 0.68;
  view.right = {1, 0, 0};
  view.down = {0, -kCosine, -kSine};
  view.forward = {0, kSine, -kCosine};
  view.position = -kDistance_m * view.forward;
  view.position -= 0.5 * view.rig.baseline_m * view.right;
  return view;
}

std::vector<Rgb8> render_row(const View& view, Eye eye, int y) {
  const Vec3 from = view.position + (eye == Eye::right ? view.rig.baseline_m : 0.0) * view.right;
  constexpr std::array<double, 2> kOffsets{-0.25, 0.25};
  std::vector<Rgb8> row;
  for (int x = 0; x < view.rig.left.width; ++x) {
    Vec3 sum;
    for (const double dy : kOffsets)
      for (const double dx : kOffsets) sum += shade(from, unit(direction_through(view, x + dx, y + dy)));
    row.push_back({encoded(0.25 * sum.x), encoded(0.25 * sum.y), encoded(0.25 * sum.z)});
  }
  return row;
}

std::vector<float> disparity_row(const View& view, int y) {
  std::vector<float> row;
  for (int x = 0; x < view.rig.left.width; ++x) {
    const Vec3 direction = unit(direction_through(view, x, y));
    const double depth = meet(view.position, direction) * dot(direction, view.forward);
    row.push_back(static_cast<float>(view.rig.baseline_m * view.rig.left.fx / depth));
  }
  return row;
}

std::vector<std::uint8_t> label_row(const View& view, int y) {
  std::vector<std::uint8_t> row;
  for (int x = 0; x < view.rig.left.width; ++x) {
    const Vec3 direction = unit(direction_through(view, x, y));
    row.push_back(
        static_cast<std::uint8_t>(nearest(view.position + meet(view.position, direction) * direction).thing));
  }
  return row;
}

double table_disparity_px(const View& view, int x, int y) {
  const Vec3 direction = direction_through(view, x, y);
  const double depth = -view.position.z / direction.z;
  return view.rig.baseline_m * view.rig.left.fx / depth;
}

}  // namespace palpable::samples
