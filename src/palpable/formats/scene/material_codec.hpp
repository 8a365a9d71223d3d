// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/formats/packing/zip.hpp"
#include "palpable/models/material/material.hpp"

#include <cstddef>

#include <nlohmann/json.hpp>

namespace palpable::formats {

/// The JSON description of material `number`; a texture's picture is added to `members`.
Result<nlohmann::json> write_material(const models::Material& material, std::size_t number,
                                      ZipMembers& members);

/// The material of the description `j`; its texture's picture is removed from `members`. The values are not
/// checked (check_scene() does that). May throw nlohmann::json::exception for a description of another shape.
Result<models::Material> read_material(const nlohmann::json& j, ZipMembers& members);

}  // namespace palpable::formats
