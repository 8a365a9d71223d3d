// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/axis_direction.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <optional>

namespace palpable::sculpt {

/// How a solid lies in the scene, which is seen along -z.
enum class Lay {
  /// Flat where it is less than a quarter as high as it is wide and deep (a map, a plate), else upright.
  automatic,
  /// Its up is the scene's up (+y): seen from the front.
  upright,
  /// Its up points to the person (+z): seen from above.
  flat
};

/// How a solid comes into the scene.
struct PlacementOptions {
  /// Width, height and depth of the box that it is fitted into, each 1 mm ... 1 m. Not given: see
  /// placement_of().
  std::optional<Vec3> size_m;
  /// Which way is up in the solid's own coordinates. Not given: as its format's convention says.
  std::optional<AxisDirection> up;
  Lay lay = Lay::automatic;
};

/// Where a solid without a size of its own is fitted: the default working volume.
inline constexpr Vec3 kWorkingVolume_m{0.10, 0.10, 0.05};
/// A longest side within these is one that a hand can feel.
inline constexpr double kLeastForAHand_m = 0.02;
inline constexpr double kMostForAHand_m = 0.25;

struct Placement {
  Transform<SceneFrame, models::InputFrame> scene_from_input;
  /// False: the solid keeps its metres, axes and origin.
  bool fitted = false;
  /// Never `automatic`.
  Lay lay = Lay::upright;
  AxisDirection up = AxisDirection::plus_y;
};

/// Where a solid in `box` goes, one of its units being a metre. Where no option is given and its longest side
/// is one that a hand can feel, it keeps its metres, axes and origin. Else it is turned by quarter turns,
/// `options.up` or `up_by_convention` being its up, scaled into the size (not given: the default working
/// volume), centred above the origin, its lowest point at z = 0. Where z is up, the person looks along +y;
/// where another axis is, along -z, or along +y where that is z downwards. Errors: usage for sizes out of
/// range, invalid_input for a box without a finite extent.
Result<Placement> placement_of(const Box& box, AxisDirection up_by_convention,
                               const PlacementOptions& options);

/// The quarter turns after which `towards` points to the person (+z) and `up` up (+y); where both are along
/// one axis, what was at the front is at the bottom, as of a map.
std::array<double, 9> turn_towards_person(AxisDirection towards, AxisDirection up);

/// The box after a rotation by quarter turns.
Box turned(const Box& box, const std::array<double, 9>& rotation);

/// The scale and move that fit a turned box into `size_m`, its lowest point at z = 0. Sides without extent
/// are ignored; at least one has an extent.
Transform<SceneFrame, models::InputFrame> fitted(const Box& box, const std::array<double, 9>& rotation,
                                                 Vec3 size_m);

/// Errors: usage for a side outside 1 mm ... 1 m.
Result<void> check_size_m(Vec3 size_m);

}  // namespace palpable::sculpt
