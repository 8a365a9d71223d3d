// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/frame_folder.hpp"

#include "palpable/core/text/name_order.hpp"
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/sources/picture/picture.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

namespace palpable::sources {
namespace {

namespace fs = std::filesystem;

/// NAME of NAME.depth.png; empty for other files.
std::string frame_name(const fs::path& file) {
  constexpr std::string_view kMark = ".depth.png";
  const std::string name = file.filename().string();
  return name.ends_with(kMark) ? name.substr(0, name.size() - kMark.size()) : std::string();
}

/// The colour picture of a frame, if there is one.
fs::path colour_beside(const fs::path& folder, const std::string& name) {
  for (const char* suffix : {".color.png", ".color.jpg", ".color.jpeg"}) {
    std::error_code unknown;
    if (fs::path file = folder / (name + suffix); fs::is_regular_file(file, unknown)) return file;
  }
  return {};
}

/// Metres of one unit of the folder's files.
Result<double> scale_of(const fs::path& depth) {
  constexpr double kMillimetre_m = 0.001;
  const auto stated = read_depth_sidecar(depth);
  if (!stated) return stated.error();
  if (stated->meaning.value_or(DepthMeaning::depth) != DepthMeaning::depth)
    return invalid_input("frames of a live source hold depth along the camera's axis; the sidecar states " +
                             std::string(name_of(*stated->meaning)),
                         depth.parent_path().string());
  return stated->metres_per_unit.value_or(kMillimetre_m);
}

}  // namespace

Result<FrameFolder> FrameFolder::open(const fs::path& folder) {
  FrameFolder found;
  std::error_code failed;
  std::vector<std::pair<std::string, fs::path>> named;
  for (auto it = fs::directory_iterator(folder, failed); !failed && it != fs::directory_iterator();
       it.increment(failed)) {
    std::error_code unknown;
    if (!it->is_regular_file(unknown)) continue;
    if (auto name = frame_name(it->path()); !name.empty()) named.emplace_back(std::move(name), it->path());
  }
  if (failed) return invalid_input("cannot be read: " + failed.message(), folder.string());
  if (named.empty())
    return invalid_input("holds no frames: files NAME.depth.png, and NAME.color.png or .jpg beside them",
                         folder.string());
  std::sort(named.begin(), named.end(),
            [](const auto& a, const auto& b) { return counted_before(a.first, b.first); });
  for (const auto& [name, depth] : named) found.frames_.push_back({depth, colour_beside(folder, name)});
  auto scale = scale_of(found.frames_.front().depth);
  if (!scale) return std::move(scale).error();
  found.metres_per_unit_ = *scale;
  return found;
}

Result<DepthMap> FrameFolder::depth(std::size_t k) const {
  const auto values = read_raster(frames_.at(k).depth);
  if (!values) return values.error();
  return depth_from_values(*values, metres_per_unit_).depth;
}

Result<Image> FrameFolder::colour(std::size_t k) const {
  const Frame& frame = frames_.at(k);
  if (frame.colour.empty()) return invalid_input("has no colour picture", frame.depth.string());
  return read_picture(frame.colour);
}

}  // namespace palpable::sources
