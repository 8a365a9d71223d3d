// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/fuse_frames.hpp"

#include "palpable/core/number_table.hpp"
#include "palpable/core/read_file.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/sculpt/field/level_set_surface.hpp"
#include "palpable/sculpt/points/depth_fusion.hpp"
#include "palpable/session/make/places.hpp"
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
using Pose = Transform<SceneFrame, CameraFrame>;

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
  const auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  const auto table =
      parse_number_table({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, kColumns);
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
                          std::vector<std::string>& notes) {
  auto read = sources::read_depth_picture(std::span(&file, 1), settings);
  if (!read) return read.error();
  auto* metres = std::get_if<DepthMap>(&read->depth);
  if (metres == nullptr)
    return invalid_input("holds no metres, only what is nearer and farther", file.string());
  if (!metres->camera)
    return invalid_input("states no camera, without which its depth has no width: give --calibration",
                         file.string());
  for (std::string& note : read->notes)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
  return std::move(*metres);
}

/// Whether a camera's own axes are the world's.
bool is_identity(const Pose& pose) {
  const Pose none;
  double off = norm(pose.translation_m);
  for (std::size_t i = 0; i < 9; ++i) off = std::max(off, std::abs(pose.rotation[i] - none.rotation[i]));
  return off < 1e-6;
}

}  // namespace

bool fuses_frames(const MakeOptions& options) {
  return !options.poses.empty() || (options.kind == sources::InputKind::depth && options.inputs.size() > 2);
}

Result<FusedSurface> fused_surface(const MakeOptions& options, const Work& work) {
  sources::DepthSettings settings = options.depth;
  if (!options.calibration.empty()) {
    const auto calibration = sources::read_calibration(options.calibration);
    if (!calibration) return calibration.error();
    settings.camera = sources::pinhole_of(calibration->left);
  }
  std::map<long, Pose> poses;
  if (!options.poses.empty()) {
    auto read = read_poses(options.poses);
    if (!read) return read.error();
    poses = std::move(*read);
  }
  FusedSurface fused;
  std::vector<DepthMap> maps;
  std::vector<Pose> stand;
  for (const fs::path& file : options.inputs) {
    if (work.cancelled()) return Work::interrupted();
    auto map = read_map(file, settings, fused.notes);
    if (!map) return map.error();
    const auto pose = options.poses.empty() ? Result<Pose>(Pose{}) : pose_of(poses, file, options.poses);
    if (!pose) return pose.error();
    maps.push_back(std::move(*map));
    stand.push_back(*pose);
  }
  if (std::any_of(stand.begin(), stand.end(), is_identity)) {
    fused.scene_from_input.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};
    if (!options.poses.empty())
      fused.notes.emplace_back("The poses' world is a camera's own: it was turned so that y is up.");
  }
  std::vector<sculpt::DepthView> views;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    // The input frame is the world that the poses are told in.
    const Transform<models::InputFrame, CameraFrame> world_from_camera{stand[k].rotation,
                                                                       stand[k].translation_m, 1.0};
    views.push_back({&maps[k], fused.scene_from_input * world_from_camera});
  }
  sculpt::FusionOptions fusion;
  fusion.resolution = std::clamp(options.field.resolution, 16, fusion.resolution);
  fusion.near_m = options.relief.near.value_or(fusion.near_m);
  fusion.far_m = options.relief.far.value_or(fusion.far_m);
  const auto set = sculpt::fused_depth(views, fusion, work);
  if (!set) return at_place(set.error(), options.inputs.front());
  auto surface = sculpt::surface_of_level_set(*set, work);
  if (!surface) return at_place(surface.error(), options.inputs.front());
  fused.surface = std::move(*surface);
  fused.voxel_m = norm(set->steps_m[0]);
  fused.notes.push_back(fmt::format("{} depth map{} fused in voxels of {:.3g} mm.", maps.size(),
                                    maps.size() == 1 ? " was" : "s were", 1000.0 * fused.voxel_m));
  return fused;
}

}  // namespace palpable::session
