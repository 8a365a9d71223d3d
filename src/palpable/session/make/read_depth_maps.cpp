// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/read_depth_maps.hpp"

#include "palpable/session/make/camera_poses.hpp"
#include "palpable/sources/calibration/calibration.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;
using Pose = CameraPoses::mapped_type;

/// The last number in a file name without its suffix: 15 in frame-000015.depth.png.
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

Result<Pose> pose_of(const CameraPoses& poses, const fs::path& file, const fs::path& table) {
  const auto number = number_of(file);
  if (!number) return invalid_input("has no frame number in its name, so its pose is unknown", file.string());
  const auto found = poses.find(*number);
  if (found == poses.end())
    return invalid_input(fmt::format("has no pose: {} contains none for frame {}", table.string(), *number),
                         file.string());
  return found->second;
}

Result<DepthMap> read_map(const fs::path& file, const sources::DepthSettings& settings,
                          std::vector<Note>& notes) {
  auto read = sources::read_depth_picture(std::span(&file, 1), settings);
  if (!read) return read.error();
  auto* metres = std::get_if<DepthMap>(&read->depth);
  if (metres == nullptr) return invalid_input("has no metric scale, only relative depth", file.string());
  if (!metres->camera)
    return invalid_input("states no camera, which is needed to compute sizes from depth", file.string(),
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
  CameraPoses poses;
  if (!options.poses.empty()) {
    auto read = read_camera_poses(options.poses);
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
