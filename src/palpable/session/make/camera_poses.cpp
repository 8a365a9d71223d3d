// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/camera_poses.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/core/text/number_table.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace palpable::session {

Result<CameraPoses> parse_camera_poses(std::string_view csv) {
  constexpr std::array<std::string_view, 8> kColumns{"frame", "qw", "qx", "qy", "qz", "tx", "ty", "tz"};
  const auto table = parse_number_table(csv, kColumns);
  if (!table) return table.error();
  CameraPoses poses;
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const auto row = table->row(i);
    const double length = std::sqrt(row[1] * row[1] + row[2] * row[2] + row[3] * row[3] + row[4] * row[4]);
    constexpr double kRounded = 1e-2, kMostFrames = 1e9;
    if (!(std::abs(length - 1.0) < kRounded))
      return invalid_input(fmt::format("the rotation of row {} is not a unit quaternion", i + 1));
    if (row[0] != std::floor(row[0]) || !(std::abs(row[0]) < kMostFrames))
      return invalid_input(fmt::format("the frame of row {} is not a whole number", i + 1));
    CameraPoses::mapped_type pose;
    pose.rotation = models::rotation_of({row[1] / length, row[2] / length, row[3] / length, row[4] / length});
    pose.translation_m = {row[5], row[6], row[7]};
    poses[static_cast<long>(row[0])] = pose;
  }
  return poses;
}

Result<CameraPoses> read_camera_poses(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  auto poses = parse_camera_poses(*text);
  if (!poses) return invalid_input(poses.error().message, file.string());
  return poses;
}

}  // namespace palpable::session
