// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/decoders.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <webp/decode.h>

namespace palpable::sources {

Result<Image> decode_webp(std::span<const std::byte> file) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(file.data());
  WebPBitstreamFeatures features{};
  if (WebPGetFeatures(bytes, file.size(), &features) != VP8_STATUS_OK)
    return invalid_input("is a WebP picture that is damaged or cut off");
  if (features.has_animation != 0) return invalid_input("is a moving WebP picture; save one frame of it");
  if (auto size = check_picture_size(features.width, features.height); !size) return std::move(size).error();

  Image image{features.width, features.height, features.has_alpha != 0 ? 4 : 3, 8, {}};
  const int stride = image.width * image.channels;
  std::vector<std::uint8_t> raw(static_cast<std::size_t>(stride) * static_cast<std::size_t>(image.height));
  const auto* decoded = image.channels == 4
                            ? WebPDecodeRGBAInto(bytes, file.size(), raw.data(), raw.size(), stride)
                            : WebPDecodeRGBInto(bytes, file.size(), raw.data(), raw.size(), stride);
  if (decoded == nullptr) return invalid_input("is a WebP picture that is damaged or cut off");
  image.samples.resize(raw.size());
  std::transform(raw.begin(), raw.end(), image.samples.begin(),
                 [](std::uint8_t v) { return static_cast<float>(v) / 255.0F; });
  return image;
}

}  // namespace palpable::sources
