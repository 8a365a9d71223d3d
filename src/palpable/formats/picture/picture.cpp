// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/formats/picture/pfm.hpp"
#include "palpable/formats/picture/png.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::formats {
namespace {

template <class Picture>
Result<void> write(const std::filesystem::path& path, const Picture& picture) {
  auto file = encode_png(picture);
  if (!file) {
    file.error().place = path.string();
    return std::move(file).error();
  }
  return write_file_atomically(path, *file);
}

}  // namespace

Result<void> write_png(const std::filesystem::path& path, const Raster<Rgb8>& picture) {
  return write(path, picture);
}
Result<void> write_png(const std::filesystem::path& path, const Raster<std::uint8_t>& grey) {
  return write(path, grey);
}
Result<void> write_png(const std::filesystem::path& path, const Raster<std::uint16_t>& grey) {
  return write(path, grey);
}
Result<void> write_png(const std::filesystem::path& path, const Image& picture) {
  return write(path, picture);
}

Result<void> write_pfm(const std::filesystem::path& path, const Raster<float>& values) {
  return write_file_atomically(path, encode_pfm(values));
}

Result<void> write_disparity_pfm(const std::filesystem::path& path, const Raster<float>& disparity_px) {
  Raster<float> values = disparity_px;
  for (float& v : values.values())
    if (!std::isfinite(v)) v = std::numeric_limits<float>::infinity();
  return write_pfm(path, values);
}

Result<void> write_disparity_png(const std::filesystem::path& path, const Raster<float>& disparity_px) {
  Raster<std::uint16_t> values(disparity_px.width(), disparity_px.height());
  std::transform(disparity_px.values().begin(), disparity_px.values().end(), values.values().begin(),
                 [](float d) {
                   if (!std::isfinite(d)) return std::uint16_t{0};
                   return static_cast<std::uint16_t>(std::lround(std::clamp(256.0F * d, 1.0F, 65535.0F)));
                 });
  return write_png(path, values);
}

}  // namespace palpable::formats
