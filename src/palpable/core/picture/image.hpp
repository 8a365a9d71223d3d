// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace palpable {

/// An 8-bit sRGB colour, as used on screens and in textures.
struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb8&) const = default;
};

/// A picture as stored in a file: 1 (grey), 2 (grey + alpha), 3 (RGB) or 4 (RGBA) interleaved channels of
/// float samples. Integer samples are scaled to 0 ... 1 (value/255 or value/65535; the integers can be
/// recovered exactly). Float samples keep their values. No gamma is applied. Row-major, origin at the top
/// left.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  /// Bits per sample in the file: 8, 16 or 32 (float).
  int bits = 8;
  std::vector<float> samples;

  const float* pixel(int x, int y) const {
    return samples.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
  }
};

/// Whether the sizes of a picture that a program made agree. Errors: invalid_input for a size that
/// check_picture_size() refuses, other than 1 to 4 channels, or another number of samples than these have.
Result<void> check(const Image& image);

/// "640 x 480", for messages.
std::string size_text(int width, int height);

/// Largest number of pixels of a picture or raster that is read: 64 Mi, about 8192 x 8192.
inline constexpr std::int64_t kMaxPixels = std::int64_t{1} << 26;

/// Checks a size that a file states before memory is allocated. Errors: invalid_input for a side below 1, or
/// more than kMaxPixels.
Result<void> check_picture_size(std::int64_t width, std::int64_t height);

/// Luma (Rec. 601) in the picture's own value range; alpha is ignored.
Raster<float> grey(const Image& image);

/// Clamps to 0 ... 1 and rounds to 8 bits. Grey is copied to all three channels; alpha is ignored.
Raster<Rgb8> rgb8(const Image& image);

}  // namespace palpable
