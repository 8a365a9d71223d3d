// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/geometry/axis_direction.hpp"

#include <algorithm>
#include <cstddef>

namespace palpable {
namespace {

constexpr std::array<std::string_view, kAxisDirections.size()> kNames{"x", "-x", "y", "-y", "z", "-z"};

}  // namespace

std::string_view name_of(AxisDirection direction) { return kNames[static_cast<std::size_t>(direction)]; }

std::optional<AxisDirection> axis_direction_from(std::string_view name) {
  for (const AxisDirection direction : kAxisDirections)
    if (name_of(direction) == name) return direction;
  return std::nullopt;
}

Vec3 unit_vector(AxisDirection direction) {
  const auto k = static_cast<std::size_t>(direction);
  const double sign = k % 2 == 0 ? 1.0 : -1.0;
  return {k / 2 == 0 ? sign : 0.0, k / 2 == 1 ? sign : 0.0, k / 2 == 2 ? sign : 0.0};
}

AxisDirection nearest_axis_direction(Vec3 vector) {
  return *std::max_element(kAxisDirections.begin(), kAxisDirections.end(),
                           [&](AxisDirection a, AxisDirection b) {
                             return dot(unit_vector(a), vector) < dot(unit_vector(b), vector);
                           });
}

}  // namespace palpable
