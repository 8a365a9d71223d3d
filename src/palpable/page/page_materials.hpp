// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/haptics/law/law.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace palpable::page {

/// The name that a user gave the material; nullopt if none did.
std::optional<std::string> own_name(const models::Material& material);

/// The scene's materials, as the page shows them.
std::vector<protocol::NamedMaterial> page_materials(const models::Scene& scene);

/// Edits of materials by label.
using MaterialEdits = std::map<std::int64_t, protocol::MaterialEdit>;

/// Adds an edit: of several edits of one value, the last one counts.
void add_edit(MaterialEdits& edits, const protocol::Edit& edit);

/// The materials after the edits. An edited value replaces the one that was set for all materials, which is
/// removed from `law`. Errors: usage for a material or texture that does not exist; then `law` may have
/// changed too.
Result<std::vector<models::Material>> edited_materials(std::vector<models::Material> materials,
                                                       const MaterialEdits& edits,
                                                       haptics::LawParameters& law);

}  // namespace palpable::page
