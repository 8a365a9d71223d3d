// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/formats/packing/zip.hpp"
#include "palpable/models/material/material.hpp"

#include <cstddef>

#include <nlohmann/json.hpp>

namespace palpable::formats {

/// Material `number` of a scene as its description says it; a texture's picture goes into `members`.
Result<nlohmann::json> write_material(const models::Material& material, std::size_t number,
                                      ZipMembers& members);

/// The material of its description `j`; its texture's picture is taken out of `members`. Whether its numbers
/// are sound is for check_scene() to say. May throw nlohmann::json::exception where it is not as it should
/// be.
Result<models::Material> read_material(const nlohmann::json& j, ZipMembers& members);

}  // namespace palpable::formats
