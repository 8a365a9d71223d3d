// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/study/world/robot_world.hpp"
#include "palpable/study/world/room.hpp"

#include <cstdint>

namespace palpable::study {

/// A room with a low table and three to six boxes and cylinders on it, of 4 to 10 cm, for a robot that stands
/// before it at near_place(): its wrist camera sees them 0.3 to 0.6 m away. The same seed gives the same room
/// on every machine.
Room make_near_room(std::uint64_t seed);
FloorPose near_place();

}  // namespace palpable::study
