// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/rosbridge_picture.hpp"

#include "palpable/core/text/plain_text.hpp"
#include "palpable/sources/live/frame_folder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpable::sources {
namespace {

/// A number in `bytes` at `at`, which has enough of them.
template <class Value>
Value value_at(std::span<const std::byte> bytes, std::size_t at, bool is_big_endian) {
  static_assert(std::endian::native == std::endian::little);
  std::array<std::byte, sizeof(Value)> raw;
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), sizeof(Value), raw.begin());
  if (is_big_endian) std::reverse(raw.begin(), raw.end());
  Value value;
  std::memcpy(&value, raw.data(), sizeof value);
  return value;
}

Error unknown_encoding(std::string_view what, const std::string& encoding) {
  constexpr std::size_t kMost = 40;
  const bool is_shown = encoding.size() <= kMost && is_utf8(encoding);
  return invalid_input("sends " + std::string(what) + " in an encoding that is not read" +
                       (is_shown ? " (" + plain_name(encoding) + ")" : ""));
}

/// Whether each row has this many bytes for a pixel.
Result<void> check_rows(const RosPicture& picture, std::size_t pixel_bytes) {
  const auto width = static_cast<std::size_t>(picture.width);
  if (picture.step < width * pixel_bytes || picture.data.size() < picture.step * std::size_t(picture.height))
    return invalid_input("sends less of a picture than its size needs");
  return {};
}

float depth_or_unknown(double value, double metres_per_unit) {
  const double depth_m = value * metres_per_unit;
  return depth_m > 0.0 && std::isfinite(depth_m) ? static_cast<float>(depth_m) : kUnknownDepth;
}

template <class Value>
Result<DepthMap> raw_depth(const RosPicture& picture, double metres_per_unit) {
  if (auto valid = check_rows(picture, sizeof(Value)); !valid) return std::move(valid).error();
  DepthMap depth{Raster<float>(picture.width, picture.height), std::nullopt};
  for (int y = 0; y < picture.height; ++y) {
    std::size_t at = picture.step * static_cast<std::size_t>(y);
    for (float& value : depth.depth_m.row(y)) {
      value = depth_or_unknown(static_cast<double>(value_at<Value>(picture.data, at, picture.is_big_endian)),
                               metres_per_unit);
      at += sizeof(Value);
    }
  }
  return depth;
}

constexpr double kMillimetre_m = 0.001;

Result<DepthMap> depth_in(const RosPicture& picture, std::optional<double> metres_per_unit) {
  if (picture.encoding == "16UC1" || picture.encoding == "mono16")
    return raw_depth<std::uint16_t>(picture, metres_per_unit.value_or(kMillimetre_m));
  if (picture.encoding == "32FC1") return raw_depth<float>(picture, metres_per_unit.value_or(1.0));
  return unknown_encoding("depth", picture.encoding);
}

/// The transport compressed_depth_image_transport puts 12 bytes before a PNG: an enumeration and the two
/// parameters of the quantised inverse depth of 32FC1, Z = a / (value - b).
Result<DepthMap> depth_in(const RosCompressed& picture, std::optional<double> metres_per_unit) {
  constexpr std::size_t kHeader_bytes = 12;
  const bool has_header = picture.format.find("compressedDepth") != std::string::npos;
  if (has_header && picture.data.size() <= kHeader_bytes)
    return invalid_input("sends a damaged depth picture");
  const std::span<const std::byte> bytes(picture.data);
  const auto image = decode_frame_picture(bytes.subspan(has_header ? kHeader_bytes : 0));
  if (!image) return invalid_input("sends depth that " + image.error().message);
  if (image->channels != 1 || image->bits != 16) return unknown_encoding("depth", picture.format);
  const bool is_inverse = has_header && picture.format.starts_with("32FC1");
  const double a = is_inverse ? double{value_at<float>(bytes, 4, false)} : 0.0;
  const double b = is_inverse ? double{value_at<float>(bytes, 8, false)} : 0.0;
  const double unit_m = metres_per_unit.value_or(is_inverse ? 1.0 : kMillimetre_m);
  constexpr double kLargest = 65535.0;
  DepthMap depth{Raster<float>(image->width, image->height), std::nullopt};
  std::transform(image->samples.begin(), image->samples.end(), depth.depth_m.values().begin(),
                 [&](float sample) {
                   const double value = std::round(double{sample} * kLargest);
                   if (value == 0.0) return kUnknownDepth;
                   return depth_or_unknown(is_inverse ? a / (value - b) : value, unit_m);
                 });
  return depth;
}

Result<DepthMap> depth_in(const RosCloud& cloud, const std::optional<Pinhole>& camera) {
  if (!camera)
    return invalid_input("sends a cloud, but no camera (info=/topic) onto whose picture it belongs");
  if (auto valid = check_frame_size(camera->width, camera->height); !valid) return std::move(valid).error();
  DepthMap depth{Raster<float>(camera->width, camera->height, kUnknownDepth), *camera};
  for (std::size_t row = 0; row < static_cast<std::size_t>(cloud.height); ++row)
    for (std::size_t column = 0; column < static_cast<std::size_t>(cloud.width); ++column) {
      const std::size_t at = row * cloud.row_step + column * cloud.point_step;
      const auto value = [&](std::size_t offset) {
        return double{value_at<float>(cloud.data, at + offset, cloud.is_big_endian)};
      };
      const double z = value(cloud.z);
      const double u = camera->fx * value(cloud.x) / z + camera->cx;
      const double v = camera->fy * value(cloud.y) / z + camera->cy;
      // Also false for NaN.
      const bool is_inside =
          z > 0.0 && u > -0.5 && v > -0.5 && u < camera->width - 0.5 && v < camera->height - 0.5;
      if (!is_inside || !std::isfinite(z)) continue;
      float& seen = depth.depth_m(static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v)));
      if (!(seen <= z)) seen = static_cast<float>(z);
    }
  return depth;
}

/// Whether most of the known depths are beyond what any depth camera sees.
bool is_too_far(const Raster<float>& depth_m) {
  constexpr float kFar_m = 100.0F;
  std::size_t known = 0, far = 0;
  for (const float z : depth_m.values()) {
    known += std::isfinite(z) ? 1U : 0U;
    far += z > kFar_m ? 1U : 0U;
  }
  return 2 * far > known;
}

/// Channels of an encoding, and where in a pixel its red, green and blue are.
struct ColourLayout {
  std::string_view encoding;
  std::size_t bytes;
  std::array<std::size_t, 3> rgb;
};
constexpr std::array<ColourLayout, 5> kColourLayouts{{{"rgb8", 3, {0, 1, 2}},
                                                      {"bgr8", 3, {2, 1, 0}},
                                                      {"rgba8", 4, {0, 1, 2}},
                                                      {"bgra8", 4, {2, 1, 0}},
                                                      {"mono8", 1, {0, 0, 0}}}};

Result<Image> raw_colour(const RosPicture& picture) {
  const auto layout = std::find_if(kColourLayouts.begin(), kColourLayouts.end(),
                                   [&](const auto& one) { return one.encoding == picture.encoding; });
  if (layout == kColourLayouts.end()) return unknown_encoding("pictures", picture.encoding);
  if (auto valid = check_rows(picture, layout->bytes); !valid) return std::move(valid).error();
  Image image{picture.width, picture.height, 3, 8, {}};
  image.samples.reserve(3 * static_cast<std::size_t>(picture.width) *
                        static_cast<std::size_t>(picture.height));
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y)
    for (std::size_t x = 0; x < static_cast<std::size_t>(picture.width); ++x)
      for (const std::size_t channel : layout->rgb)
        image.samples.push_back(static_cast<float>(std::to_integer<int>(
                                    picture.data[y * picture.step + x * layout->bytes + channel])) /
                                255.0F);
  return image;
}

}  // namespace

Result<DepthMap> depth_of(const RosBody& body, const std::optional<Pinhole>& camera,
                          std::optional<double> metres_per_unit) {
  auto depth = [&]() -> Result<DepthMap> {
    if (const auto* raw = std::get_if<RosPicture>(&body)) return depth_in(*raw, metres_per_unit);
    if (const auto* packed = std::get_if<RosCompressed>(&body)) return depth_in(*packed, metres_per_unit);
    if (const auto* cloud = std::get_if<RosCloud>(&body)) return depth_in(*cloud, camera);
    return invalid_input("sends something else than depth");
  }();
  if (!depth) return depth;
  if (is_too_far(depth->depth_m))
    return invalid_input(
        "sends depths that are mostly beyond 100 m; if they are millimetres, add scale=0.001 to the address");
  const bool is_of_camera =
      camera && camera->width == depth->depth_m.width() && camera->height == depth->depth_m.height();
  if (is_of_camera) depth->camera = camera;
  return depth;
}

Result<Image> colour_of(const RosBody& body) {
  if (const auto* raw = std::get_if<RosPicture>(&body)) return raw_colour(*raw);
  if (const auto* packed = std::get_if<RosCompressed>(&body)) {
    auto image = decode_frame_picture(packed->data);
    if (!image) return invalid_input("sends a picture that " + image.error().message);
    return image;
  }
  return invalid_input("sends something else than pictures");
}

}  // namespace palpable::sources
