// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/room.hpp"

#include "palpable/study/world/solid.hpp"

namespace palpable::study {
namespace {

/// Calls visit(object, solid) for each solid of the room.
template <class Visit>
void for_each_solid(const Room& room, const Visit& visit) {
  for (std::size_t k = 0; k < room.furniture.size(); ++k)
    for (const Solid& solid : room.furniture[k].solids) visit(static_cast<int>(k), solid);
}

struct Extent {
  Vec3 low{1e9, 1e9, 1e9};
  Vec3 high{-1e9, -1e9, -1e9};
};

Extent extent_of(const Furniture& furniture) {
  Extent e;
  for (const Solid& s : furniture.solids) {
    const TurnedSolid turned(s);
    const bool box = s.shape == Solid::Shape::box;
    const double c = std::abs(turned.cos_turn);
    const double n = std::abs(turned.sin_turn);
    const Vec3 reach{box ? c * s.half_m.x + n * s.half_m.y : s.half_m.x,
                     box ? n * s.half_m.x + c * s.half_m.y : s.half_m.x, s.half_m.z};
    const Vec3 low = s.centre_m - reach;
    const Vec3 high = s.centre_m + reach;
    e.low = {std::min(e.low.x, low.x), std::min(e.low.y, low.y), std::min(e.low.z, low.z)};
    e.high = {std::max(e.high.x, high.x), std::max(e.high.y, high.y), std::max(e.high.z, high.z)};
  }
  // What reaches into the floor begins at it.
  e.low.z = std::max(e.low.z, 0.0);
  return e;
}

}  // namespace

Hit cast_ray(const Room& room, Point<WorldFrame> origin, Vector<WorldFrame> direction) {
  Hit nearest = leave_room(room.size_m, origin.v, direction.v);
  for_each_solid(room, [&](int object, const Solid& solid) {
    const TurnedSolid turned(solid);
    Hit hit;
    hit.along = enter(solid, turned.into(origin.v - solid.centre_m), turned.into(direction.v), hit);
    if (!(hit.along < nearest.along)) return;
    hit.normal = turned.out(hit.normal);
    hit.object = object;
    nearest = hit;
  });
  return nearest;
}

double distance_m(const Room& room, Point<WorldFrame> p) {
  const Vec3 half = room.size_m / 2.0;
  const Vec3 beyond{std::abs(p.v.x) - half.x, std::abs(p.v.y) - half.y, std::abs(p.v.z - half.z) - half.z};
  const Vec3 outside{std::max(beyond.x, 0.0), std::max(beyond.y, 0.0), std::max(beyond.z, 0.0)};
  double distance = -(norm(outside) + std::min(std::max({beyond.x, beyond.y, beyond.z}), 0.0));
  for_each_solid(room, [&](int, const Solid& solid) {
    distance = std::min(distance, distance_m(TurnedSolid(solid), p.v));
  });
  return distance;
}

bool touches(const Room& room, const Footprint& f) {
  if (std::abs(f.x_m) + f.radius_m >= room.size_m.x / 2.0 ||
      std::abs(f.y_m) + f.radius_m >= room.size_m.y / 2.0)
    return true;
  bool touched = false;
  for_each_solid(room, [&](int, const Solid& solid) {
    if (solid.centre_m.z - solid.half_m.z <= f.height_m)
      touched = touched || horizontal_distance_m(TurnedSolid(solid), f.x_m, f.y_m) <= f.radius_m;
  });
  return touched;
}

Point<WorldFrame> centre_of(const Furniture& furniture) {
  const Extent e = extent_of(furniture);
  return {(e.low + e.high) / 2.0};
}

double top_m(const Furniture& furniture) { return extent_of(furniture).high.z; }

}  // namespace palpable::study
