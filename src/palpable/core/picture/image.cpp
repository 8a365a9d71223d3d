// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/image.hpp"

#include <algorithm>
#include <cmath>

namespace palpable {

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

Result<void> check_picture_size(std::int64_t width, std::int64_t height) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  // No camera and no scanner gives such a side.
  constexpr std::int64_t kLongestSide = 1'000'000;
  if (width < 1 || height < 1 || width > kLongestSide || height > kLongestSide)
    return invalid_input("is damaged: it states a size of " + size);
  if (width * height > kMaxPixels)
    return invalid_input(size + " are more than the " + std::to_string(kMaxPixels >> 20) +
                         " million that can be read: make the picture smaller first");
  return {};
}

Result<void> check(const Image& image) {
  if (auto size = check_picture_size(image.width, image.height); !size) return size;
  if (image.channels < 1 || image.channels > 4)
    return invalid_input("has " + std::to_string(image.channels) + " channels; a picture has 1 to 4");
  const auto expected = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                        static_cast<std::size_t>(image.channels);
  if (image.samples.size() != expected)
    return invalid_input("has " + std::to_string(image.samples.size()) +
                         " samples; its size and channels need " + std::to_string(expected));
  return {};
}

Raster<float> grey(const Image& image) {
  Raster<float> out(image.width, image.height);
  const bool colour = image.channels >= 3;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* p = image.pixel(x, y);
      out(x, y) = colour ? 0.299F * p[0] + 0.587F * p[1] + 0.114F * p[2] : p[0];
    }
  }
  return out;
}

Raster<Rgb8> rgb8(const Image& image) {
  const auto to8 = [](float v) {
    return static_cast<std::uint8_t>(
        std::lround(255.0F * std::clamp(std::isfinite(v) ? v : 0.0F, 0.0F, 1.0F)));
  };
  Raster<Rgb8> out(image.width, image.height);
  const bool colour = image.channels >= 3;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* p = image.pixel(x, y);
      out(x, y) = {to8(p[0]), to8(p[colour ? 1 : 0]), to8(p[colour ? 2 : 0])};
    }
  }
  return out;
}

}  // namespace palpable
