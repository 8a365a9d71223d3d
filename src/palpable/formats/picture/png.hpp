// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::formats {

/// Decodes any PNG: grey, colour or palette, 1 to 16 bits, interlaced or not; a transparent colour becomes an
/// alpha channel. Colour profiles and gamma are not applied. Errors: invalid_input for files that are
/// damaged, truncated or larger than kMaxPixels (checked before memory is allocated).
Result<Image> decode_png(std::span<const std::byte> file);

/// The pixels that a PNG states in its header, 0 for another file: to refuse a picture before its decoding.
std::uint64_t pixels_of_png(std::span<const std::byte> file);

/// Encodes exactly these values as PNG. Sizes must be at least 1 x 1. An Image keeps its channels, with 8
/// bits (values clamped to 0…1 and rounded), or 16 bits if image.bits is more than 8. Errors: failed, for a
/// size that PNG cannot hold.
Result<std::vector<std::byte>> encode_png(const Raster<Rgb8>& picture);
Result<std::vector<std::byte>> encode_png(const Raster<std::uint8_t>& grey);
Result<std::vector<std::byte>> encode_png(const Raster<std::uint16_t>& grey);
Result<std::vector<std::byte>> encode_png(const Image& picture);

}  // namespace palpable::formats
