// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>

#include <nlohmann/json.hpp>

namespace palpable::formats {

/// [x, y, z]; other values throw nlohmann::json::exception.
inline nlohmann::json json_of(Vec3 v) { return {v.x, v.y, v.z}; }
inline Vec3 vec3_from(const nlohmann::json& j) {
  const auto v = j.get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

}  // namespace palpable::formats
