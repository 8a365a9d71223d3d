// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/axis_direction.hpp"
#include "palpable/core/geometry/coordinate_convention.hpp"
#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <optional>
#include <vector>

namespace palpable::sculpt {

/// The orientation of a solid in the scene, which is viewed along -z.
enum class Lay {
  /// Flat if it is a plate or a map (PlacementOptions), else upright.
  automatic,
  /// Its up is the scene's up (+y): seen from the front.
  upright,
  /// Its up points to the user (+z): seen from above.
  flat
};

/// The size of a solid for which none is given.
enum class DefaultSize {
  /// Its own: metres, axes and origin stay as they are.
  own,
  /// Its own size if it suits a hand (PlacementOptions); else the default working volume. A solid that keeps
  /// its size but is far from its origin, or a map that is laid flat, is moved to the centre.
  for_a_hand
};

/// How a solid is placed in the scene.
struct PlacementOptions {
  /// Width, height and depth of the box that it is fitted into, each 1 mm ... 1 m.
  std::optional<Vec3> size_m;
  DefaultSize default_size = DefaultSize::own;
  /// The up direction in the solid's coordinates; if not given, that of the convention. If this or `lay` is
  /// given without a size, the solid is fitted into the default working volume.
  std::optional<AxisDirection> up;
  Lay lay = Lay::automatic;
  CoordinateConvention convention;
  /// A solid is a plate if its height is less than this share of its width and depth, 0 ... 1.
  double plate_height = 0.25;
  /// It is a map if its height is less than this share of its width and depth, 0 ... 1, and at least a share
  /// `map_level` of its surface is level (level_share()), 0 ... 1.
  double map_height = 0.5;
  double map_level = 0.6;
  /// A solid suits a hand if its longest side is in this range, metres, 1 mm ... 1 m.
  double least_side_m = 0.02;
  double most_side_m = 0.25;
  /// A solid is far from its origin if its middle is farther from it, across the view, than this share of its
  /// longest side, 0 ... 10, or twice that along the view.
  double most_off_centre = 0.5;
};
std::vector<Parameter> parameters_of(PlacementOptions& options);

/// The box of a solid without a given size: the default working volume.
inline constexpr Vec3 kWorkingVolume_m{0.10, 0.10, 0.05};

struct Placement {
  Transform<SceneFrame, models::InputFrame> scene_from_input;
  /// False: the solid keeps its metres, axes and origin.
  bool fitted = false;
  /// Only moved to the middle: it keeps its metres, and its axes unless it was laid flat.
  bool moved = false;
  /// Never `automatic`.
  Lay lay = Lay::upright;
  AxisDirection up = AxisDirection::plus_y;
};

/// The share of a mesh's surface that is level: its area as seen from above and below over its area. 1/3 for
/// a cube, 1/2 for a ball, 1 for a flat sheet. Triangles with a vertex that is missing or not finite are
/// omitted; 0 for a mesh without area.
double level_share(const Mesh& mesh, AxisDirection up);

/// The placement of a solid in `box`, one of its units being a metre. `level`: the level share of its surface
/// where it is known, else 0. It keeps its place as `default_size`
/// says. Otherwise it is rotated by quarter turns, so that its up is the scene's up or points to the user,
/// scaled into the size, and centred above the origin with its lowest point at z = 0. Upright, its front
/// faces the user: -y if z is up (as modellers' front views), +y if z is down, else +z (as glTF). Errors:
/// usage for options out of range, invalid_input for a box without a finite extent, or with one below 1e-9 m
/// or above 1e15 m.
Result<Placement> placement_of(const Box& box, const PlacementOptions& options, double level = 0.0);

/// Which side of a solid faces the user when that direction is up.
AxisDirection front_of(AxisDirection up);

/// Whether a solid of these extents has a size that a hand can feel.
bool suits_a_hand(Vec3 extent_m, const PlacementOptions& options);

/// The rotation by quarter turns after which `towards` points to the user (+z) and `up` points up (+y). If
/// both are along one axis, the front becomes the bottom, as for a map.
std::array<double, 9> turn_towards_person(AxisDirection towards, AxisDirection up);

/// The box after a rotation by quarter turns.
Box turned(const Box& box, const std::array<double, 9>& rotation);

/// The scale and translation that fit a rotated box into `size_m` with its lowest point at z = 0. Sides
/// without extent are ignored; at least one side has an extent.
Transform<SceneFrame, models::InputFrame> fitted(const Box& box, const std::array<double, 9>& rotation,
                                                 Vec3 size_m);

/// Errors: usage for a side outside 1 mm ... 1 m.
Result<void> check_size_m(Vec3 size_m);

}  // namespace palpable::sculpt
