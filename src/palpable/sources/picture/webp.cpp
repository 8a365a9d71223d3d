// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/decoders.hpp"

#include <cstddef>
#include <cstdint>

#include <webp/decode.h>

namespace palpable::sources {

Result<StoredImage> decode_webp(std::span<const std::byte> file) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(file.data());
  WebPBitstreamFeatures features{};
  if (WebPGetFeatures(bytes, file.size(), &features) != VP8_STATUS_OK)
    return invalid_input("is a WebP picture that is damaged or cut off");
  if (features.has_animation != 0) return invalid_input("is a moving WebP picture; save one frame of it");
  if (auto size = check_picture_size(features.width, features.height); !size) return std::move(size).error();

  StoredImage image{features.width, features.height, features.has_alpha != 0 ? 4 : 3, 8, {}};
  const int stride = image.width * image.channels;
  image.samples.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(image.height));
  auto* raw = reinterpret_cast<std::uint8_t*>(image.samples.data());
  const auto* decoded = image.channels == 4
                            ? WebPDecodeRGBAInto(bytes, file.size(), raw, image.samples.size(), stride)
                            : WebPDecodeRGBInto(bytes, file.size(), raw, image.samples.size(), stride);
  if (decoded == nullptr) return invalid_input("is a WebP picture that is damaged or cut off");
  return image;
}

}  // namespace palpable::sources
