// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth_camera/camera_pixels.hpp"

#include "palpable/sources/live/frame_folder.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

/// Whether the rows, of `row` bytes each, are within the block.
bool holds_rows(const LibraryPixels& pixels, std::size_t row) {
  const auto below = static_cast<std::size_t>(pixels.height) - 1;
  return pixels.data != nullptr && pixels.stride >= row && pixels.bytes >= row &&
         (below == 0 || pixels.stride <= (pixels.bytes - row) / below);
}

}  // namespace

Result<Raster<float>> depth_of_pixels(const LibraryPixels& pixels, double metres_per_unit) {
  if (auto size = check_frame_size(pixels.width, pixels.height); !size) return std::move(size).error();
  if (!std::isfinite(metres_per_unit) || metres_per_unit <= 0.0)
    return invalid_input("states no unit of its depths");
  const auto width = static_cast<std::size_t>(pixels.width);
  if (!holds_rows(pixels, width * sizeof(std::uint16_t)))
    return invalid_input(
        fmt::format("sends too few bytes for {} pixels", size_text(pixels.width, pixels.height)));
  Raster<float> depth_m(pixels.width, pixels.height);
  std::vector<std::uint16_t> row(width);
  for (int y = 0; y < pixels.height; ++y) {
    std::memcpy(row.data(),
                static_cast<const std::byte*>(pixels.data) + static_cast<std::size_t>(y) * pixels.stride,
                width * sizeof(std::uint16_t));
    for (int x = 0; x < pixels.width; ++x) {
      const int units = row[static_cast<std::size_t>(x)];
      depth_m(x, y) = units == 0 ? kUnknownDepth : static_cast<float>(units * metres_per_unit);
    }
  }
  return depth_m;
}

std::optional<Image> picture_of_pixels(const LibraryPixels& pixels) {
  constexpr int kChannels = 3;
  if (!check_frame_size(pixels.width, pixels.height)) return std::nullopt;
  const auto row = static_cast<std::size_t>(pixels.width) * kChannels;
  if (!holds_rows(pixels, row)) return std::nullopt;
  Image picture{pixels.width, pixels.height, kChannels, 8, {}};
  picture.samples.reserve(row * static_cast<std::size_t>(pixels.height));
  for (int y = 0; y < pixels.height; ++y) {
    const auto* values =
        static_cast<const std::uint8_t*>(pixels.data) + static_cast<std::size_t>(y) * pixels.stride;
    for (std::size_t k = 0; k < row; ++k) picture.samples.push_back(static_cast<float>(values[k]) / 255.0F);
  }
  return picture;
}

Error no_such_camera(const DepthCamera& camera, int present) {
  const char* name = library_name(camera.kind);
  const char* end = present == 1 ? "camera" : "cameras";
  return {ErrorCode::device,
          present <= 0 ? fmt::format("{} finds no camera: is it plugged in, and may you use it?", name)
                       : fmt::format("{} finds {} {}, counted from 0", name, present, end),
          {}};
}

Result<void> Silence::check() const {
  if (std::chrono::steady_clock::now() - last_ <= longest_) return {};
  return invalid_input(
      fmt::format("has sent no depths for {:.1f} s", static_cast<double>(longest_.count()) / 1000.0));
}

}  // namespace palpable::sources
