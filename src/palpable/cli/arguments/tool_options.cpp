// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/tool_options.hpp"

#include "palpable/core/files/read_file.hpp"

#include <numbers>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

constexpr std::size_t kCapPlaces = 32;

std::vector<haptics::ToolPlace> cane() {
  constexpr double kBall_m = 0.004, kLength_m = 0.1;
  auto places = haptics::cap_places(kBall_m, 0.5 * std::numbers::pi, kCapPlaces);
  for (haptics::ToolPlace& p : places) p.place.v.z -= kLength_m;
  return places;
}

Result<std::vector<haptics::ToolPlace>> read_tool(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  auto places = parse_tool(*text);
  if (!places) return invalid_input(places.error().message, file.string());
  return places;
}

}  // namespace

void add_tool_option(Options& options, std::string& tool) {
  options.text(
      "--tool", tool,
      "Shape that touches: point, pad (a finger's), cane (100 mm below the hand), or a CSV of places "
      "x_m,y_m,z_m,share; with torque");
}

Result<std::vector<haptics::ToolPlace>> tool_from(const std::string& tool) {
  constexpr double kPad_m = 0.008, kPadAngle_rad = 1.0;
  if (tool.empty() || tool == "point") return std::vector<haptics::ToolPlace>(1);
  if (tool == "pad") return haptics::cap_places(kPad_m, kPadAngle_rad, kCapPlaces);
  if (tool == "cane") return cane();
  std::error_code ignored;
  if (!std::filesystem::exists(tool, ignored))
    return Error{ErrorCode::usage,
                 fmt::format("there is no tool {}: there are point, pad, cane, and files of places", tool),
                 "--tool"};
  return read_tool(tool);
}

Result<ToolPath> read_tool_path(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  auto path = parse_tool_path(*text);
  if (!path) return invalid_input(path.error().message, file.string());
  return path;
}

}  // namespace palpable::cli
