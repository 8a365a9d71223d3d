// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/read_depth_maps.hpp"

#include "palpable/core/number_table.hpp"
#include "palpable/core/read_file.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/sources/calibration/calibration.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;
using Pose = Transform<models::InputFrame, CameraFrame>;

/// The last number in a file's name, its ending left out: 15 in frame-000015.depth.png.
std::optional<long> number_of(const fs::path& file) {
  const std::string name = file.stem().string();
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto last = std::find_if(name.rbegin(), name.rend(), digit).base();
  auto first = last;
  while (first != name.begin() && digit(*(first - 1))) --first;
  long number = 0;
  const auto [end, fault] = std::from_chars(&*name.begin() + (first - name.begin()),
                                            &*name.begin() + (last - name.begin()), number);
  static_cast<void>(end);
  if (first == last || fault != std::errc{}) return std::nullopt;
  return number;
}

Result<std::map<long, Pose>> read_poses(const fs::path& file) {
  constexpr std::array<std::string_view, 8> kColumns{"frame", "qw", "qx", "qy", "qz", "tx", "ty", "tz"};
  const auto text = read_text_file(file);
  if (!text) return text.error();
  const auto table = parse_number_table(*text, kColumns);
  if (!table) return invalid_input(table.error().message, file.string());
  std::map<long, Pose> poses;
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const auto row = table->row(i);
    const double length = std::sqrt(row[1] * row[1] + row[2] * row[2] + row[3] * row[3] + row[4] * row[4]);
    constexpr double kRounded = 1e-2, kMostFrames = 1e9;
    if (!(std::abs(length - 1.0) < kRounded))
      return invalid_input(fmt::format("the rotation of row {} is no unit quaternion", i + 1), file.string());
    if (row[0] != std::floor(row[0]) || !(std::abs(row[0]) < kMostFrames))
      return invalid_input(fmt::format("the frame of row {} is no whole number", i + 1), file.string());
    Pose pose;
    pose.rotation = models::rotation_of({row[1] / length, row[2] / length, row[3] / length, row[4] / length});
    pose.translation_m = {row[5], row[6], row[7]};
    poses[static_cast<long>(row[0])] = pose;
  }
  return poses;
}

Result<Pose> pose_of(const std::map<long, Pose>& poses, const fs::path& file, const fs::path& table) {
  const auto number = number_of(file);
  if (!number) return invalid_input("has no number in its name, which would say its pose", file.string());
  const auto found = poses.find(*number);
  if (found == poses.end())
    return invalid_input(fmt::format("has no pose: {} holds none of frame {}", table.string(), *number),
                         file.string());
  return found->second;
}

Result<DepthMap> read_map(const fs::path& file, const sources::DepthSettings& settings,
                          std::vector<Note>& notes) {
  auto read = sources::read_depth_picture(std::span(&file, 1), settings);
  if (!read) return read.error();
  auto* metres = std::get_if<DepthMap>(&read->depth);
  if (metres == nullptr)
    return invalid_input("holds no metres, only what is nearer and farther", file.string());
  if (!metres->camera)
    return invalid_input("states no camera, without which its depth has no width", file.string(),
                         Reason::needs_calibration);
  for (Note& note : read->notes)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
  return std::move(*metres);
}

}  // namespace

Result<sources::DepthSettings> depth_settings(const InputOptions& options) {
  sources::DepthSettings settings = options.depth;
  if (options.calibration.empty()) return settings;
  const auto calibration = sources::read_calibration(options.calibration);
  if (!calibration) return calibration.error();
  settings.camera = sources::pinhole_of(calibration->left);
  return settings;
}

Result<ReadInput> read_depth_maps(const InputOptions& options, const Work& work) {
  const auto settings = depth_settings(options);
  if (!settings) return settings.error();
  std::map<long, Pose> poses;
  if (!options.poses.empty()) {
    auto read = read_poses(options.poses);
    if (!read) return read.error();
    poses = std::move(*read);
  }
  std::vector<recipes::PosedDepth> views;
  std::vector<Note> notes;
  for (const fs::path& file : options.files) {
    if (work.cancelled()) return Work::interrupted();
    auto map = read_map(file, *settings, notes);
    if (!map) return map.error();
    const auto pose = options.poses.empty() ? Result<Pose>(Pose{}) : pose_of(poses, file, options.poses);
    if (!pose) return pose.error();
    views.push_back({std::move(*map), *pose});
  }
  return ReadInput{std::move(views), std::move(notes)};
}

}  // namespace palpable::session
