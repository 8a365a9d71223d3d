// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/export/export_tactile.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace palpable::cli {

/// Whether a map's export to this file is a text or a drawing of the map, and not one of its relief.
bool is_map_drawing(const models::Scene& scene, const std::filesystem::path& output);

/// The files that a drawing into this .svg may write or replace: the drawing, and sheets of its key.
std::vector<std::string> map_drawing_files(const std::filesystem::path& output);

/// Writes a map as a text (.txt), as a drawing for swell paper with sheets of its key (.svg), or as braille
/// dots with pages of its key (.brf). Without liblouis the braille is uncontracted, which a note says.
/// Errors: usage for options out of range; as write_file_atomically().
Result<Answer> export_map(const models::Scene& scene, const TactileArguments& arguments,
                          const std::filesystem::path& output, Console& console);

}  // namespace palpable::cli
