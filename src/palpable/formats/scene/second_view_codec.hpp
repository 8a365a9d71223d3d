// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/formats/packing/zip.hpp"
#include "palpable/models/scene/second_view.hpp"

#include <nlohmann/json_fwd.hpp>

namespace palpable::formats {

/// A scene's second view: a JPEG and a 16-bit PNG among the members; `description`: their names
/// ("second_view" in scene.json). Errors: failed.
Result<void> write_second_view(const models::SecondView& view, nlohmann::json& description,
                               ZipMembers& members);

/// Takes both out of `members`. May throw nlohmann::json::exception for a description of another shape.
/// Errors: invalid_input.
Result<models::SecondView> read_second_view(const nlohmann::json& description, ZipMembers& members);

}  // namespace palpable::formats
