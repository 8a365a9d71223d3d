// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/tool_options.hpp"

#include "palpable/cli/arguments/path_file.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <array>
#include <cmath>
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
  constexpr std::array<std::string_view, 4> kColumns{"x_m", "y_m", "z_m", "share"};
  const auto table = read_number_table(file, kColumns);
  if (!table) return table.error();
  std::vector<haptics::ToolPlace> places;
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const auto row = table->row(i);
    places.push_back({{{row[0], row[1], row[2]}}, row[3]});
  }
  if (const auto valid = haptics::check_tool(places); !valid)
    return invalid_input(valid.error().message, file.string());
  return places;
}

/// One row's pose; the columns are t, x, y, z, then the probe and the quaternion where there are some.
Result<haptics::ToolPose> pose_from(std::span<const double> row, const ToolPath& path) {
  haptics::ToolPose pose;
  pose.t_s = row[0];
  pose.scene_from_tool.translation_m = {row[1], row[2], row[3]};
  if (path.names_probes) {
    if (row[4] != std::floor(row[4]) || !(row[4] >= 0.0 && row[4] < haptics::kMaxProbes))
      return invalid_input(
          fmt::format("has a probe that is not a whole number from 0 to {}", haptics::kMaxProbes - 1));
    pose.probe = static_cast<int>(row[4]);
  }
  if (!path.turns) return pose;
  const auto q = row.last(4);
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  constexpr double kRounded = 1e-2;
  if (!(std::abs(length - 1.0) < kRounded))
    return invalid_input("has a rotation qw,qx,qy,qz that is not a unit quaternion");
  pose.scene_from_tool.rotation =
      models::rotation_of({q[0] / length, q[1] / length, q[2] / length, q[3] / length});
  return pose;
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
  constexpr std::array<std::string_view, 1> kProbe{"probe"};
  constexpr std::array<std::string_view, 4> kTurned{"qw", "qx", "qy", "qz"};
  const auto text = read_text_file(file);
  if (!text) return text.error();
  ToolPath path;
  path.names_probes = has_columns(*text, kProbe);
  path.turns = has_columns(*text, kTurned);
  std::vector<std::string_view> columns{"t_s", "x_m", "y_m", "z_m"};
  if (path.names_probes) columns.push_back(kProbe[0]);
  if (path.turns)
    for (const std::string_view name : kTurned) columns.push_back(name);
  const auto table = parse_number_table(*text, columns);
  if (!table) return invalid_input(table.error().message, file.string());
  path.poses.reserve(table->rows());
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const auto pose = pose_from(table->row(i), path);
    if (!pose) return invalid_input(fmt::format("sample {} {}", i + 1, pose.error().message), file.string());
    path.poses.push_back(*pose);
  }
  if (const auto valid = haptics::check_poses(path.poses); !valid)
    return invalid_input(valid.error().message, file.string());
  return path;
}

}  // namespace palpable::cli
