// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/image.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace palpable::study {

// World frame of a room: metres, x and y along the walls, z up; the origin is the middle of the floor.

/// An upright box, turned about the vertical, or an upright cylinder.
struct Solid {
  enum class Shape : std::uint8_t { box, cylinder };
  Shape shape = Shape::box;
  Vec3 centre_m;
  /// Half the sides of a box; of a cylinder x and y are its radius, z is half its height.
  Vec3 half_m;
  /// Angle of the box's x axis from the world's, counter-clockwise from above.
  double turn_rad = 0.0;
};

enum class Pattern : std::uint8_t { speckles, stripes, checks };

/// The look of a surface: a colour, with a pattern and irregular speckles, without which a stereo camera
/// would find nothing to match.
struct Finish {
  Rgb8 colour{200, 200, 200};
  Pattern pattern = Pattern::speckles;
  /// The width of a stripe or check; > 0.
  double pattern_m = 0.1;
};

/// A thing in the room, of one or more solids. What stands on the floor or on a table reaches into it, so
/// that its lower face is no surface; what stands at a wall reaches into the wall.
struct Furniture {
  /// Unique in its room: "table", "table 2".
  std::string name;
  Finish finish;
  std::vector<Solid> solids;
};

/// The closed room |x| <= size.x / 2, |y| <= size.y / 2, 0 <= z <= size.z.
struct Room {
  Vec3 size_m{5.0, 4.0, 2.5};
  Finish floor;
  Finish walls;
  Finish ceiling;
  std::vector<Furniture> furniture;
};

/// A furnished room: 4.4 to 6.5 m by 4 to 5.5 m, with tables (and what lies on them), cupboards and shelves
/// at the walls, and smaller things; a disc of 0.35 m radius can go round all that does not stand at a wall.
/// The same seed gives the same room on every machine.
Room make_room(std::uint64_t seed);

/// The surface that a ray meets first.
struct Hit {
  /// In units of the direction's length.
  double along = 0.0;
  /// Unit normal of the surface, against the ray.
  Vec3 normal;
  /// Position on the surface, for patterns, metres.
  double u_m = 0.0, v_m = 0.0;
  /// Index into Room::furniture; kFloor, kWalls or kCeiling.
  int object = 0;
};
inline constexpr int kFloor = -1;
inline constexpr int kWalls = -2;
inline constexpr int kCeiling = -3;

/// Exact. `origin` lies inside the room; `direction` is not zero. From inside of a solid, its far side is not
/// met.
Hit cast_ray(const Room& room, Point<WorldFrame> origin, Vector<WorldFrame> direction);

/// Distance from the nearest surface, metres: positive in the free space, negative inside of furniture and
/// beyond the walls. Exact in the free space; inside it is exact except near the joints of solids, where its
/// magnitude may be too small.
double distance_m(const Room& room, Point<WorldFrame> p);

/// Whether an upright cylinder on the floor touches anything: its axis at (x, y), its radius >= 0, and its
/// height, which decides what it fits under.
struct Footprint {
  double x_m = 0.0, y_m = 0.0;
  double radius_m = 0.0;
  double height_m = std::numeric_limits<double>::infinity();
};
bool touches(const Room& room, const Footprint& footprint);

/// The centre of the box around a thing, sides along the axes.
Point<WorldFrame> centre_of(const Furniture& furniture);
/// The height of its highest point.
double top_m(const Furniture& furniture);

}  // namespace palpable::study
