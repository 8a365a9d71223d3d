// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/frame_folder.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/core/text/name_order.hpp"
#include "palpable/formats/picture/png.hpp"
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
std::string frame_name(const std::string& file) {
  constexpr std::string_view kMark = ".depth.png";
  return file.ends_with(kMark) ? file.substr(0, file.size() - kMark.size()) : std::string();
}

/// A picture of a frame, `frame` with `.color` and the like; empty if there is none.
std::string picture_among(const std::set<std::string>& names, const std::string& picture) {
  for (const char* suffix : {".png", ".jpg", ".jpeg"})
    if (auto file = picture + suffix; names.contains(file)) return file;
  return {};
}

std::vector<FrameNames> pairs_among(const std::set<std::string>& names) {
  constexpr std::string_view kMark = ".left";
  std::vector<FrameNames> pairs;
  for (const std::string& left : names) {
    const std::string picture = fs::path(left).stem().string();
    if (!picture.ends_with(kMark) || picture_among(names, picture) != left) continue;
    auto right = picture_among(names, picture.substr(0, picture.size() - kMark.size()) + ".right");
    if (!right.empty()) pairs.push_back({{}, left, std::move(right)});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const FrameNames& a, const FrameNames& b) { return counted_before(a.colour, b.colour); });
  return pairs;
}

/// Frames are read while a hand touches the last one, so a file that is none any more is not waited for.
Result<std::vector<std::byte>> read_frame_file(const fs::path& file) {
  // More than twice the numbers of the largest frame without compression.
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{48} << 20U;
  return read_regular_file(file, kMostBytes);
}

Error too_many_pixels(std::uint64_t pixels) {
  return invalid_input("has " + std::to_string(pixels) + " pixels; a frame of a live source has at most " +
                       std::to_string(kMostFramePixels));
}

Result<Raster<float>> decode_frame(std::span<const std::byte> file) {
  if (const auto pixels = formats::pixels_of_png(file); pixels > kMostFramePixels)
    return too_many_pixels(pixels);
  auto values = decode_raster(file);
  // Not every file states its size at its beginning.
  if (values && values->count() > kMostFramePixels) return too_many_pixels(values->count());
  return values;
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

Result<void> check_frame_size(int width, int height) {
  if (auto possible = check_picture_size(width, height); !possible) return possible;
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels > kMostFramePixels) return too_many_pixels(pixels);
  return {};
}

Result<Image> decode_frame_picture(std::span<const std::byte> file) {
  auto picture = decode_picture(file);
  if (!picture) return picture;
  if (auto size = check_frame_size(picture->width, picture->height); !size) return std::move(size).error();
  return picture;
}

std::vector<FrameNames> frames_among(const std::set<std::string>& names) {
  std::vector<std::string> found;
  for (const std::string& file : names)
    if (auto name = frame_name(file); !name.empty()) found.push_back(std::move(name));
  std::sort(found.begin(), found.end(), counted_before);
  std::vector<FrameNames> frames;
  for (const std::string& name : found)
    frames.push_back({name + ".depth.png", picture_among(names, name + ".color")});
  return frames.empty() ? pairs_among(names) : frames;
}

Result<FrameFolder> FrameFolder::open(const fs::path& folder) {
  FrameFolder found;
  std::error_code failed;
  std::set<std::string> names;
  for (auto it = fs::directory_iterator(folder, failed); !failed && it != fs::directory_iterator();
       it.increment(failed)) {
    std::error_code unknown;
    if (it->is_regular_file(unknown)) names.insert(it->path().filename().string());
  }
  if (failed) return invalid_input("cannot be read: " + failed.message(), folder.string());
  found.folder_ = folder;
  found.frames_ = frames_among(names);
  if (found.frames_.empty())
    return invalid_input(
        "holds no frames: files NAME.depth.png, and NAME.color.png or .jpg beside them; or pairs "
        "NAME.left.png "
        "and NAME.right.png",
        folder.string());
  if (found.has_pairs()) return found;
  auto scale = scale_of(folder / found.frames_.front().depth);
  if (!scale) return std::move(scale).error();
  found.metres_per_unit_ = *scale;
  return found;
}

Result<DepthMap> FrameFolder::depth(std::size_t k) const {
  const fs::path path = folder_ / frames_.at(k).depth;
  const auto file = read_frame_file(path);
  if (!file) return file.error();
  const auto values = decode_frame(*file);
  if (!values) return Error{values.error().code, values.error().message, path.string()};
  return depth_from_values(*values, metres_per_unit_).depth;
}

Result<std::pair<Image, Image>> FrameFolder::pair(std::size_t k) const {
  const FrameNames& frame = frames_.at(k);
  auto left = picture(frame.colour);
  if (!left) return std::move(left).error();
  auto right = picture(frame.right);
  if (!right) return std::move(right).error();
  return std::pair(*std::move(left), *std::move(right));
}

Result<Image> FrameFolder::colour(std::size_t k) const {
  const FrameNames& frame = frames_.at(k);
  if (frame.colour.empty()) return invalid_input("has no colour picture", (folder_ / frame.depth).string());
  return picture(frame.colour);
}

Result<Image> FrameFolder::picture(const std::string& name) const {
  const fs::path path = folder_ / name;
  const auto file = read_frame_file(path);
  if (!file) return file.error();
  auto picture = decode_frame_picture(*file);
  if (!picture) picture.error().place = path.string();
  return picture;
}

}  // namespace palpable::sources
