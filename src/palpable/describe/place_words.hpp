// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/models/scene/scene.hpp"

#include <string>

// Where a probe is and what is there, in words. `depth` multiplies the height of a relief, as the person has
// set it: -4 ... 4, negative where the scene is engraved.

namespace palpable::describe {

/// The ninth of a rectangle around the origin that a place is in: "upper left", "centre", "middle right".
std::string region_words(Place place, double width_m, double depth_m);
/// "32 millimetres left, 12 millimetres up"; "here" within half a millimetre.
std::string offset_words(double dx_m, double dy_m);
/// "at the middle", or the offset "from the middle".
std::string from_middle_words(Place place);
/// "rising steeply to the upper right", "level". The slope is dz/dx and dz/dy.
std::string slope_words(double dzdx, double dzdy);
/// A heading, 0 up the scene, to the left positive: "up", "left", "up and right" for the eighths of a turn,
/// else the nearest quarter with the degrees from it: "up, turned 15 degrees left".
std::string heading_words(double heading_rad);
/// A line's direction, which has no sign: "from left to right", "from lower left to upper right".
std::string line_words(double angle_rad);

/// The name of the material at a place; empty where it has none of its own.
std::string name_at(const models::Scene& scene, Place place);

/// All about a place: region, way from the middle, height and slope (of contours: the line), name.
std::string position_words(const models::Scene& scene, double depth, Place place);
/// What a step led to, short: name, height and slope; of contours whether the probe is on a line.
std::string step_words(const models::Scene& scene, double depth, Place place);
/// "pressed 1.5 millimetres deep", "lifted by 2 millimetres".
std::string press_words(double press_m);
/// What a probe feels at a place: region, way from the middle, height, force in newtons, name.
std::string felt_words(const models::Scene& scene, double depth, Place place, double force_N);

}  // namespace palpable::describe
