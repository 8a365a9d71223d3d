// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/models/scene/scene.hpp"

#include <string>
#include <vector>

// Describes in words where a probe is and what is there. `height_factor` is the user's factor on the height
// of a relief: -4 ... 4, negative if the scene is engraved.

namespace palpable::describe {

class PlaceGuide;

/// Which ninth of a rectangle around the origin contains a place: "upper left", "centre", "middle right".
std::string region_words(Place place, double size_x_m, double size_y_m);
/// Places in their order, each once: "3 upper left; centre". Empty without any.
std::string counted_places(const std::vector<std::string>& places);
/// "32 millimetres left, 12 millimetres up"; "here" within half a millimetre.
std::string offset_words(double dx_m, double dy_m);
/// "at the middle", or the offset "from the middle".
std::string from_middle_words(Place place);
/// "rising steeply to the upper right", "level". The slope is dz/dx and dz/dy.
std::string slope_words(double dzdx, double dzdy);
/// A heading, 0 = up, positive to the left: "up", "left", "up and right" for multiples of 45 degrees, else
/// the nearest multiple of 90 degrees with the rest: "up, turned 15 degrees left".
std::string heading_words(double heading_rad);
/// The direction of an undirected line: "from left to right", "from lower left to upper right".
std::string line_words(double angle_rad);

/// What is said at the end of a map's route, within 3 mm of it.
inline constexpr const char* kRouteEnd = "the end of the route";
bool is_at_route_end(const models::Scene& scene, Place place);

/// The name that a person gave a place, else that of its material; or kRouteEnd. Empty where it has none of
/// its own.
std::string name_at(const models::Scene& scene, Place place);

/// Everything about a place: region, offset from the middle, height and slope (for contours: the line), all
/// names that cover it, with the sentences that persons gave. `guide`: of the scene. Heights of a solid are
/// above its base, or from its back if it stands upright; beside it is "nothing", and where the surface is.
std::string position_words(const models::Scene& scene, double height_factor, Place place,
                           const PlaceGuide& guide);
/// The place after a step, in short: name, height and slope; for contours, whether the probe is on a line.
std::string step_words(const models::Scene& scene, double height_factor, Place place);
/// "pressed 1.5 millimetres deep", "lifted by 2 millimetres"; beside a solid there is nothing to press.
std::string press_words(const models::Scene& scene, Place place, double press_m);
/// What a probe feels at a place: region, offset from the middle, height, force in newtons, name.
std::string felt_words(const models::Scene& scene, double height_factor, Place place, double force_N);

}  // namespace palpable::describe
