// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <optional>
#include <string_view>

namespace palpable {

/// A direction along a coordinate axis.
enum class AxisDirection { plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };

inline constexpr std::array kAxisDirections{AxisDirection::plus_x, AxisDirection::minus_x,
                                            AxisDirection::plus_y, AxisDirection::minus_y,
                                            AxisDirection::plus_z, AxisDirection::minus_z};

/// "x", "-x", "y" ...; and the reverse, nullopt for an unknown name.
std::string_view name_of(AxisDirection direction);
std::optional<AxisDirection> axis_direction_from(std::string_view name);

Vec3 unit_vector(AxisDirection direction);

/// The direction with the smallest angle to a vector, which must not be 0.
AxisDirection nearest_axis_direction(Vec3 vector);

}  // namespace palpable
