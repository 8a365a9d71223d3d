// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/haptics/servo/tool_path.hpp"

#include <string_view>
#include <vector>

namespace palpable::cli {

/// The poses of one or several probes.
struct ToolPath {
  std::vector<haptics::ToolPose> poses;
  bool names_probes = false;
  bool turns = false;
};

/// A path from a CSV text with t_s,x_m,y_m,z_m; optionally a column probe for several probes, and qw,qx,qy,qz
/// for the orientation (scene_from_tool). Errors (invalid_input, without a place): as parse_number_table()
/// and haptics::check_poses().
Result<ToolPath> parse_tool_path(std::string_view csv);

/// A tool's points in the tool frame from a CSV text with x_m,y_m,z_m,share. Errors (invalid_input, without a
/// place): as parse_number_table() and haptics::check_tool().
Result<std::vector<haptics::ToolPlace>> parse_tool(std::string_view csv);

}  // namespace palpable::cli
