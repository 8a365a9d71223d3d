// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/solid.hpp"

#include <limits>

namespace palpable::study {
namespace {

constexpr double kMissed = std::numeric_limits<double>::infinity();

/// Distance from an interval |x| <= half, negative inside.
double beyond(double x, double half) { return std::abs(x) - half; }

/// Signed distance of a body that is the product of a plane figure and a vertical interval, from the signed
/// distances to both.
double product_distance(double plane, double vertical) {
  const double outside = std::hypot(std::max(plane, 0.0), std::max(vertical, 0.0));
  return outside + std::min(std::max(plane, vertical), 0.0);
}

double rectangle_distance(double x, double y, Vec3 half) {
  return product_distance(beyond(x, half.x), beyond(y, half.y));
}

double figure_distance(const Solid& solid, double x, double y) {
  return solid.shape == Solid::Shape::box ? rectangle_distance(x, y, solid.half_m)
                                          : std::hypot(x, y) - solid.half_m.x;
}

}  // namespace

double enter_box(Vec3 half, Vec3 o, Vec3 d, Hit& hit) {
  // The slab test of Kay & Kajiya (1986): a division by zero gives an infinity of the right sign.
  const double tx = (std::copysign(half.x, -d.x) - o.x) / d.x;
  const double ty = (std::copysign(half.y, -d.y) - o.y) / d.y;
  const double tz = (std::copysign(half.z, -d.z) - o.z) / d.z;
  const double ends[] = {(std::copysign(half.x, d.x) - o.x) / d.x, (std::copysign(half.y, d.y) - o.y) / d.y,
                         (std::copysign(half.z, d.z) - o.z) / d.z};
  const double from = std::max({tx, ty, tz});
  // NOT (a <= b) so that a NaN (a ray in the plane of a face) is a miss.
  if (!(from <= std::min({ends[0], ends[1], ends[2]})) || !(from > 0.0)) return kMissed;
  const Vec3 p = o + from * d;
  if (from == tx)
    hit.normal = {std::copysign(1.0, -d.x), 0, 0}, hit.u_m = p.y, hit.v_m = p.z;
  else if (from == ty)
    hit.normal = {0, std::copysign(1.0, -d.y), 0}, hit.u_m = p.x, hit.v_m = p.z;
  else
    hit.normal = {0, 0, std::copysign(1.0, -d.z)}, hit.u_m = p.x, hit.v_m = p.y;
  return from;
}

double enter_cylinder(Vec3 half, Vec3 o, Vec3 d, Hit& hit) {
  const double a = d.x * d.x + d.y * d.y;
  const double b = o.x * d.x + o.y * d.y;
  const double c = o.x * o.x + o.y * o.y - half.x * half.x;
  const double root2 = b * b - a * c;
  if (a > 0.0 && root2 < 0.0) return kMissed;
  if (a == 0.0 && c > 0.0) return kMissed;
  const double root = std::sqrt(std::max(root2, 0.0));
  const double side_in = a > 0.0 ? (-b - root) / a : -kMissed;
  const double side_out = a > 0.0 ? (-b + root) / a : kMissed;
  const double face_in =
      d.z != 0.0 ? (std::copysign(half.z, -d.z) - o.z) / d.z : (std::abs(o.z) <= half.z ? -kMissed : kMissed);
  const double face_out = d.z != 0.0 ? (std::copysign(half.z, d.z) - o.z) / d.z : kMissed;
  const double from = std::max(side_in, face_in);
  if (!(from <= std::min(side_out, face_out)) || !(from > 0.0)) return kMissed;
  const Vec3 p = o + from * d;
  if (from == side_in)
    hit.normal = {p.x / half.x, p.y / half.x, 0}, hit.u_m = half.x * std::atan2(p.y, p.x), hit.v_m = p.z;
  else
    hit.normal = {0, 0, std::copysign(1.0, -d.z)}, hit.u_m = p.x, hit.v_m = p.y;
  return from;
}

Hit leave_room(Vec3 size, Vec3 o, Vec3 d) {
  const Vec3 half = size / 2.0;
  const double tx = d.x == 0.0 ? kMissed : (std::copysign(half.x, d.x) - o.x) / d.x;
  const double ty = d.y == 0.0 ? kMissed : (std::copysign(half.y, d.y) - o.y) / d.y;
  const double tz = d.z == 0.0 ? kMissed : ((d.z > 0.0 ? size.z : 0.0) - o.z) / d.z;
  Hit hit;
  hit.along = std::min({tx, ty, tz});
  const Vec3 p = o + hit.along * d;
  if (hit.along == tz)
    hit.normal = {0, 0, std::copysign(1.0, -d.z)}, hit.u_m = p.x, hit.v_m = p.y,
    hit.object = d.z > 0.0 ? kCeiling : kFloor;
  else if (hit.along == tx)
    hit.normal = {std::copysign(1.0, -d.x), 0, 0}, hit.u_m = p.y, hit.v_m = p.z, hit.object = kWalls;
  else
    hit.normal = {0, std::copysign(1.0, -d.y), 0}, hit.u_m = p.x, hit.v_m = p.z, hit.object = kWalls;
  return hit;
}

double distance_m(const TurnedSolid& turned, Vec3 p) {
  const Vec3 q = turned.into(p - turned.solid.centre_m);
  return product_distance(figure_distance(turned.solid, q.x, q.y), beyond(q.z, turned.solid.half_m.z));
}

double horizontal_distance_m(const TurnedSolid& turned, double x_m, double y_m) {
  const Vec3 q = turned.into(Vec3{x_m, y_m, 0.0} - turned.solid.centre_m);
  return std::max(0.0, figure_distance(turned.solid, q.x, q.y));
}

}  // namespace palpable::study
