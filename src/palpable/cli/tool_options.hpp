// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/haptics/servo/tool_path.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace palpable::cli {

/// Adds --tool. `tool` must outlive the parsing.
void add_tool_option(Options& options, std::string& tool);

/// "" and "point": one place at the hand. "pad": a finger pad of 8 mm radius. "cane": the ball of 4 mm radius
/// at the end of a stick that is held 100 mm above it. Else a CSV file of places in the tool's own frame,
/// x_m,y_m,z_m,share. Errors: usage for a word that is none of these and no file; invalid_input, naming the
/// file.
Result<std::vector<haptics::ToolPlace>> tool_from(const std::string& tool);

/// The poses of one or several probes, and what the file said of them.
struct ToolPath {
  std::vector<haptics::ToolPose> poses;
  bool names_probes = false;
  bool turns = false;
};

/// A path from a CSV with t_s,x_m,y_m,z_m; where there is a column probe, of several probes; where there are
/// qw,qx,qy,qz, turned (scene from tool). Errors: as read_path().
Result<ToolPath> read_tool_path(const std::filesystem::path& file);

}  // namespace palpable::cli
