// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/near_scene.hpp"

#include "palpable/study/world/sound_random.hpp"

#include <array>
#include <string>
#include <utility>

namespace palpable::study {
namespace {

constexpr double kTable_m = 0.50;
/// From the robot's axis to the table's edge.
constexpr double kEdge_m = 0.24;

}  // namespace

FloorPose near_place() { return {}; }

Room make_near_room(std::uint64_t seed) {
  SoundRandom random(seed);
  const auto between = [&](double low, double high) { return random.between(low, high); };
  constexpr std::array kPatterns{Pattern::speckles, Pattern::stripes, Pattern::checks};
  const auto finish = [&] {
    const auto channel = [&] { return static_cast<std::uint8_t>(between(90.0, 230.0)); };
    const Rgb8 colour{channel(), channel(), channel()};
    return Finish{colour, kPatterns[random.below(kPatterns.size())], between(0.015, 0.05)};
  };
  Room room{{4.0, 4.0, 2.5}, finish(), finish(), finish(), {}};
  room.furniture.push_back(
      {"table",
       finish(),
       {{Solid::Shape::box, {kEdge_m + 0.4, 0.0, kTable_m - 0.02}, {0.4, 0.6, 0.02}, 0.0}}});
  const auto count = 3 + random.below(4);
  for (std::uint64_t k = 0; k < count; ++k) {
    const double half_m = between(0.02, 0.05), height_m = between(0.04, 0.1);
    Solid solid{random.below(2) == 0 ? Solid::Shape::box : Solid::Shape::cylinder,
                {between(0.3, 0.6), between(-0.18, 0.18), kTable_m + height_m / 2.0 - 0.005},
                {half_m, half_m, height_m / 2.0 + 0.005},
                between(0.0, 1.5)};
    room.furniture.push_back({"thing " + std::to_string(k + 1), finish(), {solid}});
  }
  return room;
}

}  // namespace palpable::study
