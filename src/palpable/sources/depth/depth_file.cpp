// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/depth_file.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/file_bytes.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/formats/packing/npz.hpp"
#include "palpable/sources/picture/file_marks.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/sources/picture/picture_reply.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace palpable::sources {
namespace {

/// The original numbers of one channel: an Image stores integers as value / maximum, from which they are
/// recovered exactly.
Result<Raster<float>> values_of(const Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const float most = image.bits == 8 ? 255.0F : image.bits == 16 ? 65535.0F : 1.0F;
  Raster<float> out(image.width, image.height);
  for (std::size_t i = 0; i < out.count(); ++i) {
    const float* p = image.samples.data() + i * channels;
    if (channels >= 3 && (p[0] != p[1] || p[0] != p[2]))
      return invalid_input("is a coloured picture, not a map of depth or disparity");
    out.values()[i] = image.bits == 32 ? p[0] : std::round(most * p[0]);
  }
  return out;
}

Result<Raster<float>> raster_in(const formats::Npz& arrays) {
  for (const char* name : {"depth", "depth_m", "disparity", "arr_0"})
    if (const auto found = arrays.find(name); found != arrays.end()) return formats::raster_of(found->second);
  if (arrays.size() == 1) return formats::raster_of(arrays.begin()->second);
  return invalid_input("holds " + std::to_string(arrays.size()) +
                       " arrays, none of them named depth, depth_m, disparity or arr_0");
}

/// The largest map in the widest numbers, with room for small arrays beside it.
constexpr std::uint64_t kMostArrayBytes = 8 * static_cast<std::uint64_t>(kMaxPixels) + (1U << 20U);

bool is_known(float v) { return std::isfinite(v) && v > 0.0F; }

Error bad_scale(const char* what, const std::filesystem::path& path) {
  return {ErrorCode::usage, std::string(what) + " must be a positive number", path.string()};
}

}  // namespace

Result<Raster<float>> decode_raster(FileView file) {
  if (has_magic(file, "PK\x03\x04")) {
    const auto arrays = formats::decode_npz(file, kMostArrayBytes);
    return arrays ? raster_in(*arrays) : arrays.error();
  }
  if (has_magic(file, "\x93NUMPY")) {
    const auto array = formats::decode_npy(file);
    return array ? formats::raster_of(*array) : array.error();
  }
  if (is_exr(file)) return isolated::decode_exr_depth(file);
  const auto image = decode_picture(file);
  return image ? values_of(*image) : image.error();
}

Result<Raster<float>> read_raster(const std::filesystem::path& path) {
  const auto file = read_file_bytes(path, is_decoded_in_child);
  if (!file) return file.error();
  auto values = decode_raster(file->view());
  if (!values) values.error().place = path.string();
  return values;
}

DepthFile depth_from_values(const Raster<float>& values, double metres_per_unit) {
  DepthFile out{{Raster<float>(values.width(), values.height(), kUnknownDepth), std::nullopt}, 0};
  for (std::size_t i = 0; i < values.count(); ++i) {
    const auto z = static_cast<float>(metres_per_unit * static_cast<double>(values.values()[i]));
    if (is_known(z))
      out.depth.depth_m.values()[i] = z;
    else
      ++out.unknown;
  }
  return out;
}

Result<DepthFile> read_depth(const std::filesystem::path& path, double metres_per_unit) {
  if (!std::isfinite(metres_per_unit) || metres_per_unit <= 0.0)
    return bad_scale("the depth scale in metres per unit", path);
  const auto values = read_raster(path);
  if (!values) return values.error();
  DepthFile out = depth_from_values(*values, metres_per_unit);
  if (out.unknown == values->count())
    return invalid_input("has no pixel with a depth: all are zero, negative or not a number", path.string());
  return out;
}

Result<DisparityFile> read_disparity(const std::filesystem::path& path, double px_per_unit,
                                     UnknownDisparity unknown) {
  if (!std::isfinite(px_per_unit) || px_per_unit <= 0.0)
    return bad_scale("the disparity scale in pixels per unit", path);
  const auto values = read_raster(path);
  if (!values) return values.error();
  DisparityFile out{{Raster<float>(values->width(), values->height(), kUnknownDepth), std::nullopt}, 0};
  for (std::size_t i = 0; i < values->count(); ++i) {
    const float v = values->values()[i];
    if (std::isfinite(v) && v >= 0.0F && !(unknown == UnknownDisparity::zero_too && v == 0.0F))
      out.disparity.disparity_px.values()[i] = static_cast<float>(px_per_unit * static_cast<double>(v));
    else
      ++out.unknown;
  }
  if (out.unknown == values->count()) return invalid_input("has no pixel with a disparity", path.string());
  return out;
}

}  // namespace palpable::sources
