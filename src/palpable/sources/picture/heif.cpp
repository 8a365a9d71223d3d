// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/sources/picture/photo_depth.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

#include <libheif/heif.h>

namespace palpable::sources {
namespace {

struct Release {
  void operator()(heif_context* p) const { heif_context_free(p); }
  void operator()(const heif_image_handle* p) const { heif_image_handle_release(p); }
  void operator()(const heif_image* p) const { heif_image_release(p); }
  void operator()(const heif_depth_representation_info* p) const { heif_depth_representation_info_free(p); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

Error damaged(const heif_error& error) {
  return invalid_input(std::string("is a HEIF picture that is damaged, cut off or of an unknown kind (") +
                       (error.message != nullptr ? error.message : "no reason given") + ")");
}

struct Opened {
  Owned<heif_context> context;
  Owned<heif_image_handle> primary;
};

Result<Opened> open(std::span<const std::byte> file) {
  Opened out;
  out.context.reset(heif_context_alloc());
  // libheif's own limit, checked before it allocates pixels; the exact limit is checked later.
  constexpr int kMaxSide = 65535;
  heif_context_set_maximum_image_size_limit(out.context.get(), kMaxSide);
  heif_error error =
      heif_context_read_from_memory_without_copy(out.context.get(), file.data(), file.size(), nullptr);
  if (error.code != heif_error_Ok) return damaged(error);
  heif_image_handle* primary = nullptr;
  error = heif_context_get_primary_image_handle(out.context.get(), &primary);
  if (error.code != heif_error_Ok) return damaged(error);
  out.primary.reset(primary);
  return out;
}

Result<Owned<heif_image>> pixels_of(const heif_image_handle* handle, heif_colorspace space,
                                    heif_chroma chroma) {
  if (auto size =
          check_picture_size(heif_image_handle_get_width(handle), heif_image_handle_get_height(handle));
      !size)
    return std::move(size).error();
  heif_image* image = nullptr;
  const heif_error error = heif_decode_image(handle, &image, space, chroma, nullptr);
  if (error.code != heif_error_Ok) return damaged(error);
  return Owned<heif_image>(image);
}

/// One row-major plane of 8-bit or (little-endian) 9 to 16-bit samples, as 0 … 1.
void read_plane(const heif_image* image, heif_channel channel, int row_samples, int height,
                std::vector<float>& out) {
  int stride = 0;
  const std::uint8_t* plane = heif_image_get_plane_readonly(image, channel, &stride);
  const int bits = heif_image_get_bits_per_pixel_range(image, channel);
  const float most = static_cast<float>((1U << static_cast<unsigned>(bits)) - 1U);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* row = plane + static_cast<std::ptrdiff_t>(y) * stride;
    for (int x = 0; x < row_samples; ++x) {
      const int raw = bits > 8 ? row[2 * x] | (row[2 * x + 1] << 8) : row[x];
      out.push_back(static_cast<float>(raw) / most);
    }
  }
}

/// The interleaved samples with as many bits as `image` has: those of 9 to 15 bits are scaled to 16.
std::vector<std::byte> colours_in(const heif_image* pixels, const StoredImage& image) {
  int stride = 0;
  const std::uint8_t* plane = heif_image_get_plane_readonly(pixels, heif_channel_interleaved, &stride);
  const auto row_samples = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  const auto sample_bytes = static_cast<std::size_t>(image.bits / 8);
  std::vector<std::byte> out(row_samples * static_cast<std::size_t>(image.height) * sample_bytes);
  const auto bits =
      static_cast<unsigned>(heif_image_get_bits_per_pixel_range(pixels, heif_channel_interleaved));
  const std::uint32_t most = (1U << bits) - 1U;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* row = plane + static_cast<std::ptrdiff_t>(y) * stride;
    std::byte* to = out.data() + static_cast<std::size_t>(y) * row_samples * sample_bytes;
    if (image.bits == 8) {
      std::memcpy(to, row, row_samples);
      continue;
    }
    for (std::size_t x = 0; x < row_samples; ++x) {
      const std::uint32_t raw = std::min(row[2 * x] | (std::uint32_t{row[2 * x + 1]} << 8U), most);
      const auto scaled = static_cast<std::uint16_t>((raw * 65535U + most / 2) / most);
      std::memcpy(to + 2 * x, &scaled, sizeof scaled);
    }
  }
  return out;
}

void apply_representation(const heif_image_handle* primary, heif_item_id id, PhotoDepth& depth) {
  const heif_depth_representation_info* raw = nullptr;
  if (heif_image_handle_get_depth_image_representation_info(primary, id, &raw) == 0 || raw == nullptr) return;
  const Owned<const heif_depth_representation_info> info(raw);
  const bool planes =
      info->has_z_near != 0 && info->has_z_far != 0 && info->z_near > 0.0 && info->z_far > info->z_near;
  if (info->depth_representation_type == heif_depth_representation_type_uniform_Z)
    depth.coding = PhotoDepth::Coding::range_linear;
  const bool metric = info->depth_representation_type == heif_depth_representation_type_uniform_Z ||
                      info->depth_representation_type == heif_depth_representation_type_uniform_inverse_Z;
  if (metric && planes) {
    depth.near_m = info->z_near;
    depth.far_m = info->z_far;
  }
}

}  // namespace

void load_heif_plugins() { heif_init(nullptr); }

Result<StoredImage> decode_heif(std::span<const std::byte> file) {
  const auto opened = open(file);
  if (!opened) return opened.error();
  const bool alpha = heif_image_handle_has_alpha_channel(opened->primary.get()) != 0;
  const bool deep = heif_image_handle_get_luma_bits_per_pixel(opened->primary.get()) > 8;
  const heif_chroma chroma =
      deep ? (alpha ? heif_chroma_interleaved_RRGGBBAA_LE : heif_chroma_interleaved_RRGGBB_LE)
           : (alpha ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB);
  const auto pixels = pixels_of(opened->primary.get(), heif_colorspace_RGB, chroma);
  if (!pixels) return pixels.error();
  StoredImage image;
  image.width = heif_image_get_width(pixels->get(), heif_channel_interleaved);
  image.height = heif_image_get_height(pixels->get(), heif_channel_interleaved);
  image.channels = alpha ? 4 : 3;
  image.bits = deep ? 16 : 8;
  if (auto size = check_picture_size(image.width, image.height); !size) return std::move(size).error();
  image.samples = colours_in(pixels->get(), image);
  return image;
}

bool heif_announces_depth(std::span<const std::byte> file) {
  const auto opened = open(file);
  return opened && heif_image_handle_get_number_of_depth_images(opened->primary.get()) > 0;
}

Result<std::optional<PhotoDepth>> depth_in_heif(std::span<const std::byte> file) {
  const auto opened = open(file);
  if (!opened) return opened.error();
  heif_item_id id = 0;
  if (heif_image_handle_get_list_of_depth_image_IDs(opened->primary.get(), &id, 1) < 1)
    return std::optional<PhotoDepth>();
  heif_image_handle* raw = nullptr;
  const heif_error error = heif_image_handle_get_depth_image_handle(opened->primary.get(), id, &raw);
  if (error.code != heif_error_Ok) return damaged(error);
  const Owned<heif_image_handle> handle(raw);
  // The luma is the depth, with or without unused colour planes.
  auto pixels = pixels_of(handle.get(), heif_colorspace_YCbCr, heif_chroma_420);
  if (!pixels) pixels = pixels_of(handle.get(), heif_colorspace_monochrome, heif_chroma_monochrome);
  if (!pixels) return pixels.error();
  const heif_image* image = pixels->get();
  const int width = heif_image_get_width(image, heif_channel_Y);
  const int height = heif_image_get_height(image, heif_channel_Y);
  if (auto size = check_picture_size(width, height); !size) return std::move(size).error();
  std::vector<float> values;
  read_plane(image, heif_channel_Y, width, height, values);
  PhotoDepth depth{Raster<float>(width, height), PhotoDepth::Coding::nearness, {}, {}};
  std::copy(values.begin(), values.end(), depth.values.values().begin());
  apply_representation(opened->primary.get(), id, depth);
  return std::optional(std::move(depth));
}

}  // namespace palpable::sources
