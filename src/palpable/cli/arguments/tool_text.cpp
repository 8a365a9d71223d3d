// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/tool_text.hpp"

#include "palpable/core/text/number_table.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

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

Result<std::vector<haptics::ToolPlace>> parse_tool(std::string_view csv) {
  constexpr std::array<std::string_view, 4> kColumns{"x_m", "y_m", "z_m", "share"};
  const auto table = parse_number_table(csv, kColumns);
  if (!table) return table.error();
  std::vector<haptics::ToolPlace> places;
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const auto row = table->row(i);
    places.push_back({{{row[0], row[1], row[2]}}, row[3]});
  }
  if (auto valid = haptics::check_tool(places); !valid) return std::move(valid).error();
  return places;
}

Result<ToolPath> parse_tool_path(std::string_view csv) {
  constexpr std::array<std::string_view, 1> kProbe{"probe"};
  constexpr std::array<std::string_view, 4> kTurned{"qw", "qx", "qy", "qz"};
  ToolPath path;
  path.names_probes = has_columns(csv, kProbe);
  path.turns = has_columns(csv, kTurned);
  std::vector<std::string_view> columns{"t_s", "x_m", "y_m", "z_m"};
  if (path.names_probes) columns.push_back(kProbe[0]);
  if (path.turns)
    for (const std::string_view name : kTurned) columns.push_back(name);
  const auto table = parse_number_table(csv, columns);
  if (!table) return table.error();
  path.poses.reserve(table->rows());
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const auto pose = pose_from(table->row(i), path);
    if (!pose) return invalid_input(fmt::format("sample {} {}", i + 1, pose.error().message));
    path.poses.push_back(*pose);
  }
  if (auto valid = haptics::check_poses(path.poses); !valid) return std::move(valid).error();
  return path;
}

}  // namespace palpable::cli
