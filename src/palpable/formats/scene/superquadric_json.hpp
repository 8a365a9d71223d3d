// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace palpable::formats {

/// {type: "superquadric", size_m: [a1, a2, a3], exponents: [e1, e2], rotation: [qw, qx, qy, qz], position_m,
/// taper: [kx, ky], bend, bend_angle_rad}: the form in a scene's description and in `info`.
nlohmann::json json_of(const models::Superquadric& shape);

/// Taper, bend and rotation may be left out. May throw nlohmann::json::exception for another shape. Errors:
/// invalid_input, as models::check_superquadric().
Result<models::Superquadric> superquadric_from(const nlohmann::json& json);

/// The list `primitives` of an object: 1 to 256 of them. Throws and errors as superquadric_from().
Result<std::vector<models::Superquadric>> superquadrics_from(const nlohmann::json& json);

/// Reads {"primitives": [...]}: 1 to 256 superquadrics. Errors: invalid_input, naming the file.
Result<std::vector<models::Superquadric>> read_superquadrics(const std::filesystem::path& path);

/// The same in memory. Errors without a place.
Result<std::vector<models::Superquadric>> decode_superquadrics(std::span<const std::byte> file);

}  // namespace palpable::formats
