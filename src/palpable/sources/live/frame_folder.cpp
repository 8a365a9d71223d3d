// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/frame_folder.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/core/text/name_order.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/sources/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
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

Result<Raster<float>> decode_frame(std::span<const std::byte> file) {
  if (const auto pixels = formats::pixels_of_png(file); pixels > kMostFramePixels)
    return too_many_pixels(pixels);
  auto values = decode_raster(file);
  // Not every file states its size at its beginning.
  if (values && values->count() > kMostFramePixels) return too_many_pixels(values->count());
  return values;
}

/// What the folder states of its depth files. Errors also for depth that is not along the axis.
Result<DepthSettings> settings_of(const fs::path& depth) {
  auto stated = read_depth_sidecar(depth);
  if (stated && stated->meaning.value_or(DepthMeaning::depth) != DepthMeaning::depth)
    return invalid_input("frames of a live source hold depth along the camera's axis; the sidecar states " +
                             std::string(name_of(*stated->meaning)),
                         depth.parent_path().string());
  return stated;
}

/// The numbers of a text file of exactly `count` numbers.
Result<std::vector<double>> read_matrix(const fs::path& file, std::size_t count) {
  const auto bytes = read_regular_file(file, 4096);
  if (!bytes) return bytes.error();
  const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; numbers.size() <= count && words >> word;) {
    const auto number = finite_number(word);
    if (!number) return invalid_input("holds something that is no number", file.string());
    numbers.push_back(*number);
  }
  if (numbers.size() != count)
    return invalid_input("must hold " + std::to_string(count) + " numbers", file.string());
  return numbers;
}

/// The camera of a 3 x 3 matrix, of no size.
Result<Pinhole> read_intrinsics(const fs::path& file) {
  const auto k = read_matrix(file, 9);
  if (!k) return k.error();
  const Pinhole camera{(*k)[0], (*k)[4], (*k)[2], (*k)[5], 0, 0};
  if (!(camera.fx > 0.0 && camera.fy > 0.0))
    return invalid_input("is no camera: its focal lengths must be positive", file.string());
  return camera;
}

/// Whether the matrix is a rotation, as exactly as files of six digits state it.
bool is_rigid(const Transform<WorldFrame, palpable::CameraFrame>& pose) {
  constexpr double kRounding = 1e-3;
  const auto& r = pose.rotation;
  const Vec3 x{r[0], r[3], r[6]}, y{r[1], r[4], r[7]}, z{r[2], r[5], r[8]};
  return std::abs(norm(x) - 1.0) < kRounding && std::abs(norm(y) - 1.0) < kRounding &&
         norm(cross(x, y) - z) < 2.0 * kRounding;
}

}  // namespace

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
    frames.push_back({name + ".depth.png",
                      picture_among(names, name + ".color"),
                      {},
                      names.contains(name + ".pose.txt") ? name + ".pose.txt" : std::string()});
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
  const auto settings = settings_of(folder / found.frames_.front().depth);
  if (!settings) return settings.error();
  found.metres_per_unit_ = settings->metres_per_unit.value_or(found.metres_per_unit_);
  found.camera_ = settings->camera;
  for (const char* file : {"intrinsics.K.txt", "camera-intrinsics.txt"}) {
    if (found.camera_ || !names.contains(file)) continue;
    auto camera = read_intrinsics(folder / file);
    if (!camera) return std::move(camera).error();
    found.camera_ = *camera;
  }
  return found;
}

Result<DepthMap> FrameFolder::depth(std::size_t k) const {
  const fs::path path = folder_ / frames_.at(k).depth;
  const auto file = read_frame_file(path);
  if (!file) return file.error();
  const auto values = decode_frame(*file);
  if (!values) return Error{values.error().code, values.error().message, path.string()};
  DepthMap depth = depth_from_values(*values, metres_per_unit_).depth;
  if (!camera_) return depth;
  const int width = depth.depth_m.width(), height = depth.depth_m.height();
  if (camera_->width == 0 || (camera_->width == width && camera_->height == height)) {
    depth.camera = camera_;
    depth.camera->width = width, depth.camera->height = height;
  }
  return depth;
}

Result<std::optional<Transform<WorldFrame, palpable::CameraFrame>>> FrameFolder::pose(std::size_t k) const {
  using Pose = Transform<WorldFrame, palpable::CameraFrame>;
  const FrameNames& frame = frames_.at(k);
  if (frame.pose.empty()) return std::optional<Pose>();
  const auto m = read_matrix(folder_ / frame.pose, 16);
  if (!m) return m.error();
  const std::vector<double>& v = *m;
  const Pose pose{{v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10]}, {v[3], v[7], v[11]}, 1.0};
  if (!is_rigid(pose))
    return invalid_input("is no pose: its first three columns must be a rotation",
                         (folder_ / frame.pose).string());
  return std::optional(pose);
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
