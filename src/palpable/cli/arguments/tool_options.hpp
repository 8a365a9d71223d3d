// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/arguments/tool_text.hpp"
#include "palpable/cli/options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace palpable::cli {

/// Adds --tool. `tool` must outlive the parsing.
void add_tool_option(Options& options, std::string& tool);

/// The tool of --tool. "" and "point": one point at the hand. "pad": a finger pad of 8 mm radius. "cane": a
/// ball of 4 mm radius at the end of a stick that is held 100 mm above it. Else a CSV file of points in the
/// tool frame, x_m,y_m,z_m,share. Errors: usage for an unknown word that is not a file; invalid_input, naming
/// the file.
Result<std::vector<haptics::ToolPlace>> tool_from(const std::string& tool);

/// Reads a path (tool_text.hpp). Errors: as read_path().
Result<ToolPath> read_tool_path(const std::filesystem::path& file);

}  // namespace palpable::cli
