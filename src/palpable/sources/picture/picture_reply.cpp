// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/picture_reply.hpp"

#include "palpable/sources/isolated/flat.hpp"
#include "palpable/sources/isolated/isolated.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

namespace palpable::sources::isolated {
namespace {

/// Integer samples as 0 ... 1, by a table.
template <class T>
std::vector<float> scaled(std::span<const std::byte> raw) {
  static const std::vector<float> kValues = [] {
    constexpr std::size_t kMost = std::numeric_limits<T>::max();
    std::vector<float> values(kMost + 1);
    for (std::size_t k = 0; k <= kMost; ++k) values[k] = static_cast<float>(k) / static_cast<float>(kMost);
    return values;
  }();
  std::vector<float> out(raw.size() / sizeof(T));
  for (std::size_t k = 0; k < out.size(); ++k) {
    T code{};
    std::memcpy(&code, raw.data() + k * sizeof(T), sizeof(T));
    out[k] = kValues[code];
  }
  return out;
}

void put_layout(FlatWriter& reply, const std::array<std::int32_t, 4>& width_height_channels_bits) {
  begin_value(reply);
  for (const std::int32_t value : width_height_channels_bits) reply.put(value);
}

std::vector<float> get_samples(FlatReader& reply, int bits, std::uint64_t count) {
  switch (bits) {
    case 8:
      return scaled<std::uint8_t>(reply.get_bytes(count));
    case 16:
      return scaled<std::uint16_t>(reply.get_bytes(count * sizeof(std::uint16_t)));
    default:
      return reply.get_array<float>(count);
  }
}

void put_raster(FlatWriter& reply, const Raster<float>& values) {
  reply.put(static_cast<std::int32_t>(values.width()));
  reply.put(static_cast<std::int32_t>(values.height()));
  reply.put_array(std::span<const float>(values.values()));
}

Result<Raster<float>> get_raster(FlatReader& reply) {
  const auto width = reply.get<std::int32_t>(), height = reply.get<std::int32_t>();
  if (!check_picture_size(width, height)) return invalid_reply();
  const auto samples =
      reply.get_array<float>(static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height));
  if (!reply.ok()) return invalid_reply();
  Raster<float> values(width, height);
  std::copy(samples.begin(), samples.end(), values.values().begin());
  return values;
}

std::optional<double> get_length(FlatReader& reply) {
  const bool known = reply.get<std::uint8_t>() == 1;
  const auto value = reply.get<double>();
  return known ? std::optional(value) : std::nullopt;
}

void put_length(FlatWriter& reply, const std::optional<double>& value) {
  reply.put(static_cast<std::uint8_t>(value.has_value()));
  reply.put(value.value_or(0.0));
}

template <class T>
Result<T> in_child(Job job, FileView file, Result<T> (*read)(std::span<const std::byte>)) {
  const auto reply = decode(job, file);
  if (!reply) return reply.error();
  return read(reply->bytes());
}

}  // namespace

std::vector<std::byte> reply_head(const StoredImage& image) {
  FlatWriter reply;
  put_layout(reply, {image.width, image.height, image.channels, image.bits});
  return reply.take();
}

std::vector<std::byte> reply_of(const Image& image) {
  FlatWriter reply;
  put_layout(reply, {image.width, image.height, image.channels, image.bits});
  reply.put_array(std::span<const float>(image.samples));
  return reply.take();
}

std::vector<std::byte> reply_of(const Raster<float>& values) {
  FlatWriter reply;
  begin_value(reply);
  put_raster(reply, values);
  return reply.take();
}

std::vector<std::byte> reply_of(const std::optional<PhotoDepth>& depth) {
  FlatWriter reply;
  begin_value(reply);
  reply.put(static_cast<std::uint8_t>(depth.has_value()));
  if (!depth) return reply.take();
  reply.put(depth->coding);
  put_length(reply, depth->near_m);
  put_length(reply, depth->far_m);
  put_raster(reply, depth->values);
  return reply.take();
}

Result<Image> image_in(std::span<const std::byte> bytes) {
  FlatReader reply(bytes);
  if (auto opened = open_reply(reply); !opened) return std::move(opened).error();
  Image image;
  image.width = reply.get<std::int32_t>();
  image.height = reply.get<std::int32_t>();
  image.channels = reply.get<std::int32_t>();
  image.bits = reply.get<std::int32_t>();
  const bool known =
      image.channels >= 1 && image.channels <= 4 && (image.bits == 8 || image.bits == 16 || image.bits == 32);
  if (!known || !check_picture_size(image.width, image.height)) return invalid_reply();
  image.samples =
      get_samples(reply, image.bits,
                  static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height) *
                      static_cast<std::uint64_t>(image.channels));
  if (!reply.done()) return invalid_reply();
  return image;
}

Result<Raster<float>> raster_in(std::span<const std::byte> bytes) {
  FlatReader reply(bytes);
  if (auto opened = open_reply(reply); !opened) return std::move(opened).error();
  auto values = get_raster(reply);
  if (values && !reply.done()) return invalid_reply();
  return values;
}

Result<std::optional<PhotoDepth>> photo_depth_in(std::span<const std::byte> bytes) {
  FlatReader reply(bytes);
  if (auto opened = open_reply(reply); !opened) return std::move(opened).error();
  if (reply.get<std::uint8_t>() == 0)
    return reply.done() ? Result<std::optional<PhotoDepth>>(std::optional<PhotoDepth>()) : invalid_reply();
  const auto coding = reply.get<PhotoDepth::Coding>();
  const auto near_m = get_length(reply), far_m = get_length(reply);
  auto values = get_raster(reply);
  if (!values || !reply.done() || coding > PhotoDepth::Coding::nearness) return invalid_reply();
  for (const auto& plane : {near_m, far_m})
    if (plane && !(*plane > 0.0)) return invalid_reply();
  return std::optional(PhotoDepth{*std::move(values), coding, near_m, far_m});
}

Result<Image> decode_tiff(FileView file) { return in_child(Job::tiff, file, image_in); }
Result<Image> decode_webp(FileView file) { return in_child(Job::webp, file, image_in); }
Result<Image> decode_exr(FileView file) { return in_child(Job::exr, file, image_in); }
Result<Raster<float>> decode_exr_depth(FileView file) { return in_child(Job::exr_depth, file, raster_in); }
Result<Image> decode_heif(FileView file) { return in_child(Job::heif, file, image_in); }
Result<std::optional<PhotoDepth>> depth_in_heif(FileView file) {
  return in_child(Job::heif_depth, file, photo_depth_in);
}

bool heif_announces_depth(FileView file) {
  const auto answer = decode(Job::heif_announces_depth, file);
  if (!answer) return false;
  FlatReader reply(answer->bytes());
  return open_reply(reply) && reply.get<std::uint8_t>() == 1;
}

}  // namespace palpable::sources::isolated
