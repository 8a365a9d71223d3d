// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/placement_notes.hpp"

#include "palpable/core/text/figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

/// "1 : 250" or "4 : 1", with two digits.
std::string scale_text(double scale) {
  return scale <= 1.0 ? fmt::format("1 : {}", figure(1.0 / scale)) : fmt::format("{} : 1", figure(scale));
}

/// Very small units by their number in a millimetre, since their length would be "0".
std::string unit_text(double unit_mm) {
  constexpr double kSmall_mm = 0.001, kHuge = 1e15;
  if (!(unit_mm < kHuge)) return fmt::format("one unit being {:.2g} mm", unit_mm);
  if (!(unit_mm > 1.0 / kHuge)) return fmt::format("{:.2g} units being one mm", 1.0 / unit_mm);
  return unit_mm >= kSmall_mm ? fmt::format("one unit being {} mm", figure(unit_mm, 3))
                              : fmt::format("{} units being one mm", figure(1.0 / unit_mm, 3));
}

}  // namespace

std::vector<Note> rounding_notes(const sculpt::Box& box, double step) {
  const double share = step / norm(box.size_m());
  constexpr double kFelt = 1e-4;
  if (!(share > kFelt)) return {};
  return {
      Note{fmt::format("The mesh is far from its origin: its corners were read in single precision, in steps "
                       "of up to {} % of its size. Move it to its origin for its true shape.",
                       figure(100.0 * share))}};
}

std::vector<Note> placement_notes(const sculpt::Placement& placement, const sculpt::Box& box,
                                  const sculpt::PlacementOptions& options) {
  std::vector<Note> notes;
  // A solid that keeps its coordinates is of the size that they give in metres.
  const bool keeps_size = !placement.fitted || placement.moved;
  if (keeps_size && options.convention.unit == LengthUnit::unknown &&
      options.default_size == sculpt::DefaultSize::for_a_hand)
    notes.emplace_back("The input states no unit: its coordinates were taken as metres.");
  if (!placement.fitted) return notes;
  if (placement.moved) {
    const bool laid_flat =
        placement.lay == sculpt::Lay::flat && dot(unit_vector(placement.up), Vec3{0.0, 0.0, 1.0}) == 0.0;
    notes.emplace_back(laid_flat
                           ? "The input is wide and low and most of its surface is level: it lies flat, "
                             "seen from above."
                           : "The input is far from its origin: it was centred.");
    return notes;
  }
  const Vec3 extent = box.size_m();
  const double scale = placement.scene_from_input.scale;
  if (options.convention.unit == LengthUnit::metre) {
    notes.emplace_back(fmt::format("The input is {} x {} x {} m; its scale here is {}.", figure(extent.x, 3),
                                   figure(extent.y, 3), figure(extent.z, 3), scale_text(scale)));
  } else if (!options.size_m) {
    notes.emplace_back(
        fmt::format("The input states no unit: it was scaled to fit a hand, {}.", unit_text(1000.0 * scale)));
  }
  const bool asked = options.up && options.lay != sculpt::Lay::automatic;
  const bool as_it_was = placement.lay == sculpt::Lay::upright && placement.up == AxisDirection::plus_y;
  if (!asked && !as_it_was)
    notes.emplace_back(
        fmt::format("The up axis of the input was assumed to be {}; {}.", name_of(placement.up),
                    placement.lay == sculpt::Lay::flat ? "it lies flat, seen from above"
                                                       : "it stands upright, seen from the front"));
  return notes;
}

}  // namespace palpable::recipes
