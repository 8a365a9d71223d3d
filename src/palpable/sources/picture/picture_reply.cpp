// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/picture_reply.hpp"

#include "palpable/sources/isolated/flat.hpp"
#include "palpable/sources/isolated/isolated.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::sources::isolated {
namespace {

constexpr float kMost8 = 255.0F, kMost16 = 65535.0F;

/// How the samples travel: integers take a quarter or half of what floats take.
enum class Coding : std::uint8_t { u8, u16, f32 };

template <class T>
std::vector<T> integers(const std::vector<float>& samples, float most) {
  std::vector<T> out(samples.size());
  std::transform(samples.begin(), samples.end(), out.begin(),
                 [most](float v) { return static_cast<T>(std::clamp(v, 0.0F, 1.0F) * most + 0.5F); });
  return out;
}

template <class T>
std::vector<float> floats(std::span<const std::byte> raw, float most) {
  std::vector<float> out(raw.size() / sizeof(T));
  const std::byte* at = raw.data();
  for (float& v : out) {
    T value{};
    std::memcpy(&value, at, sizeof(T));
    at += sizeof(T);
    v = static_cast<float>(value) / most;
  }
  return out;
}

template <class T>
bool are_integers(const std::vector<float>& samples, const std::vector<T>& coded, float most) {
  return std::equal(samples.begin(), samples.end(), coded.begin(),
                    [most](float v, T code) { return v == static_cast<float>(code) / most; });
}

/// True where the samples come back bit by bit.
template <class T>
bool put_integers(FlatWriter& reply, const std::vector<float>& samples, Coding coding, float most) {
  const auto coded = integers<T>(samples, most);
  if (!are_integers(samples, coded, most)) return false;
  reply.put(coding);
  reply.put_array(std::span<const T>(coded));
  return true;
}

void put_samples(FlatWriter& reply, const Image& image) {
  if (image.bits == 8 && put_integers<std::uint8_t>(reply, image.samples, Coding::u8, kMost8)) return;
  if (image.bits == 16 && put_integers<std::uint16_t>(reply, image.samples, Coding::u16, kMost16)) return;
  reply.put(Coding::f32);
  reply.put_array(std::span<const float>(image.samples));
}

std::vector<float> get_samples(FlatReader& reply, std::uint64_t count) {
  switch (reply.get<Coding>()) {
    case Coding::u8:
      return floats<std::uint8_t>(reply.get_bytes(count), kMost8);
    case Coding::u16:
      return floats<std::uint16_t>(reply.get_bytes(count * sizeof(std::uint16_t)), kMost16);
    case Coding::f32:
      return reply.get_array<float>(count);
  }
  return {};
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
Result<T> in_child(Job job, std::span<const std::byte> file, Result<T> (*read)(std::span<const std::byte>)) {
  const auto reply = decode(job, file);
  if (!reply) return reply.error();
  return read(reply->bytes());
}

}  // namespace

std::vector<std::byte> reply_of(const Image& image) {
  FlatWriter reply;
  begin_value(reply);
  for (const int value : {image.width, image.height, image.channels, image.bits})
    reply.put(static_cast<std::int32_t>(value));
  put_samples(reply, image);
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
      get_samples(reply, static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height) *
                             static_cast<std::uint64_t>(image.channels));
  if (!reply.done()) return invalid_reply();
  // Written so that NaN fails; float files keep whatever they hold.
  const auto in_range = [](float v) { return v >= 0.0F && v <= 1.0F; };
  if (image.bits != 32 && !std::all_of(image.samples.begin(), image.samples.end(), in_range))
    return invalid_reply();
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

Result<Image> decode_tiff(std::span<const std::byte> file) { return in_child(Job::tiff, file, image_in); }
Result<Image> decode_webp(std::span<const std::byte> file) { return in_child(Job::webp, file, image_in); }
Result<Image> decode_exr(std::span<const std::byte> file) { return in_child(Job::exr, file, image_in); }
Result<Raster<float>> decode_exr_depth(std::span<const std::byte> file) {
  return in_child(Job::exr_depth, file, raster_in);
}
Result<Image> decode_heif(std::span<const std::byte> file) { return in_child(Job::heif, file, image_in); }
Result<std::optional<PhotoDepth>> depth_in_heif(std::span<const std::byte> file) {
  return in_child(Job::heif_depth, file, photo_depth_in);
}

bool heif_announces_depth(std::span<const std::byte> file) {
  const auto answer = decode(Job::heif_announces_depth, file);
  if (!answer) return false;
  FlatReader reply(answer->bytes());
  return open_reply(reply) && reply.get<std::uint8_t>() == 1;
}

}  // namespace palpable::sources::isolated
