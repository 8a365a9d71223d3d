// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/export/export_tactile.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>

namespace palpable::cli {

/// Whether a map's export to this file is a text or a drawing of the map, and not one of its relief.
bool is_map_drawing(const models::Scene& scene, const std::filesystem::path& output);

/// Writes a map as a text (.txt), as the pins of a tactile display (.pbm), or as write_drawing().
/// Errors: usage for options out of range; as write_file_atomically().
Result<Answer> export_map(const models::Scene& scene, const TactileArguments& arguments,
                          const std::filesystem::path& output, Console& console);

}  // namespace palpable::cli
