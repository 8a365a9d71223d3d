// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/video/video_outputs.hpp"

#include "palpable/cli/video/video_mesh.hpp"
#include "palpable/cli/video/video_report.hpp"
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/formats/mesh/ply.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/sources/input/input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::cli {
namespace {

namespace fs = std::filesystem;
using recipes::VideoReconstruction;

Result<void> add_text(const fs::path& path, const std::string& text, AtomicFiles& files) {
  return files.add(path, std::as_bytes(std::span(text)));
}

Result<void> add_poses(const fs::path& path, const VideoReconstruction& video, AtomicFiles& files) {
  std::string text = "frame,qw,qx,qy,qz,tx,ty,tz\n";
  for (const auto& [frame, pose] : video.poses) {
    const auto q = models::quaternion_of(pose.rotation);
    const Vec3 t = pose.translation_m;
    text += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9g},{:.9g},{:.9g}\n", frame, q[0], q[1], q[2],
                        q[3], t.x, t.y, t.z);
  }
  return add_text(path, text, files);
}

Result<void> add_structure(const fs::path& path, const VideoReconstruction& video, AtomicFiles& files) {
  const auto bytes = formats::encode_ply(video.structure);
  if (!bytes) return bytes.error();
  return files.add(path, *bytes);
}

// The unit in which the greatest depth fits into 16 bits.
double depth_unit(const VideoReconstruction& video) {
  float greatest = 0.0F;
  for (const auto& depth : video.depth_maps)
    for (const float z : depth.map.depth_m.values())
      if (z > greatest) greatest = z;
  return static_cast<double>(greatest) / 65535.0;
}

/// The depth maps of an earlier run, which have another scale: NUMBER.png beside a depth.json.
std::vector<fs::path> depth_maps_in(const fs::path& folder) {
  std::vector<fs::path> maps;
  std::error_code fault;
  if (!fs::exists(folder / "depth.json", fault)) return maps;
  for (auto it = fs::directory_iterator(folder, fault); !fault && it != fs::directory_iterator();
       it.increment(fault)) {
    const std::string number = it->path().stem().string();
    const bool is_number = !number.empty() && std::all_of(number.begin(), number.end(),
                                                          [](char c) { return c >= '0' && c <= '9'; });
    if (is_number && it->path().extension() == ".png") maps.push_back(it->path());
  }
  return maps;
}

Result<void> add_depth_maps(const fs::path& folder, const VideoReconstruction& video, AtomicFiles& files) {
  if (auto made = files.make_folder(folder); !made) return made;
  std::vector<fs::path> outdated = depth_maps_in(folder);
  const double unit = depth_unit(video);
  for (const auto& depth : video.depth_maps) {
    Raster<std::uint16_t> values(depth.map.depth_m.width(), depth.map.depth_m.height());
    std::transform(depth.map.depth_m.values().begin(), depth.map.depth_m.values().end(),
                   values.values().begin(), [&](float z) {
                     return z > 0 ? static_cast<std::uint16_t>(std::lround(static_cast<double>(z) / unit))
                                  : std::uint16_t{0};
                   });
    const auto png = formats::encode_png(values);
    if (!png) return png.error();
    const fs::path file = folder / fmt::format("{:04}.png", depth.frame_number);
    if (auto added = files.add(file, *png); !added) return added;
    std::erase(outdated, file);
  }
  for (const fs::path& old : outdated) files.remove_after(old);
  const Pinhole& camera = *video.depth_maps.front().map.camera;
  const nlohmann::json sidecar{{"scale", unit},          {"fx", camera.fx}, {"fy", camera.fy},
                               {"cx", camera.cx},        {"cy", camera.cy}, {"width", camera.width},
                               {"height", camera.height}};
  return add_text(folder / "depth.json", sidecar.dump(2) + "\n", files);
}

Error wrong_output(std::string message, const fs::path& place) {
  return {ErrorCode::usage, std::move(message), place.string()};
}

// Accepts a new folder, an empty one, or one with earlier depth maps.
Result<void> check_depth_folder(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder, none)) {
    const fs::path parent = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
    return fs::is_directory(parent, none) ? Result<void>()
                                          : wrong_output("there is no folder " + parent.string(), folder);
  }
  const bool ours = fs::exists(folder / "depth.json", none) || fs::is_empty(folder, none);
  return ours ? Result<void>() : wrong_output("holds other files; name a new folder", folder);
}

}  // namespace

void add_video_outputs(Options& options, VideoOutputs& outputs) {
  options.under("Videos");
  options.output("--structure", outputs.structure, {".ply"}, "Write the points that were found, PLY");
  options.output("--report", outputs.report, {".html"}, "Write a page about the video and its result, HTML");
  options.output("--mesh", outputs.mesh, {".glb"}, "Write the surface in the video's colours, GLB");
  options.output_folder("--depth-dir", outputs.depth_folder,
                        "Write the depth maps that were computed, 16-bit PNG, and their scale");
}

std::string video_name(const std::vector<std::string>& inputs) {
  fs::path path(inputs.front());
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

bool is_video(const std::vector<std::string>& inputs, const std::string& kind) {
  if (inputs.size() != 1 || (!kind.empty() && kind != sources::name_of(sources::InputKind::video)))
    return false;
  std::error_code none;
  if (fs::is_directory(inputs.front(), none)) return true;
  const auto found = sources::kind_of_file(inputs.front());
  return found && *found == sources::InputKind::video;
}

Result<void> check_no_video_outputs(const VideoOutputs& outputs, const std::vector<std::string>& inputs) {
  for (const auto& [name, value] :
       {std::pair("--structure", &outputs.structure), std::pair("--depth-dir", &outputs.depth_folder),
        std::pair("--report", &outputs.report), std::pair("--mesh", &outputs.mesh)})
    if (!value->empty()) {
      // A missing file is no video either: that it is missing says more.
      std::error_code none;
      for (const std::string& input : inputs)
        if (const auto kind = sources::kind_of_file(input); !kind && !fs::is_directory(input, none))
          return kind.error();
      return Error{ErrorCode::usage, "only videos have this output", name};
    }
  return {};
}

Result<void> check_video_outputs(const VideoOutputs& outputs) {
  return outputs.depth_folder.empty() ? Result<void>() : check_depth_folder(outputs.depth_folder);
}

Json steps_of(const VideoReconstruction& video) {
  constexpr std::array kKinds{"segments", "superquadrics", "sampling", "correction"};
  Json out = Json::array();
  for (const auto& step : video.steps)
    out.push_back({{"kind", kKinds[static_cast<std::size_t>(step.kind)]},
                   {"frame", step.frame_number},
                   {"error_m", step.error_m},
                   {"taken", step.taken}});
  return out;
}

Result<void> add_video_outputs(const VideoOutputs& outputs, const VideoResult& result, AtomicFiles& files,
                               const Work& work) {
  const VideoReconstruction& video = result.video;
  if (!outputs.poses.empty())
    if (auto added = add_poses(outputs.poses, video, files); !added) return added;
  if (!outputs.structure.empty())
    if (auto added = add_structure(outputs.structure, video, files); !added) return added;
  if (!outputs.report.empty()) {
    const auto page = video_report(result.name, video, result.scene, result.notes);
    if (!page) return page.error();
    if (auto added = add_text(outputs.report, *page, files); !added) return added;
  }
  if (!outputs.mesh.empty()) {
    const auto glb = video_glb(video, result.scene, work);
    if (!glb) return glb.error();
    if (auto added = files.add(outputs.mesh, *glb); !added) return added;
  }
  return outputs.depth_folder.empty() ? Result<void>() : add_depth_maps(outputs.depth_folder, video, files);
}

}  // namespace palpable::cli
