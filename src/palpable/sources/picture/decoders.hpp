// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/picture/stored_image.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources {

// One function per file format. All call check_picture_size() before they allocate memory, and return
// invalid_input, without a place, for damaged, truncated or unsupported files. None applies an orientation
// except BMP and TGA, whose row order is part of the pixel layout. TIFF and WebP are parsed by external
// libraries and only in the decoder process, which picture.cpp calls (picture_reply.hpp).

/// Grey or RGB, with or without alpha, of 8 or 16 bit integers or 32-bit floats, in strips or tiles;
/// everything else that libtiff knows (palettes, YCbCr, fax) as 8-bit RGBA. After an error the samples that
/// were put so far are worth nothing.
Result<void> decode_tiff(std::span<const std::byte> file, SampleSink& sink);
/// The first frame, as RGB or RGBA.
Result<StoredImage> decode_webp(std::span<const std::byte> file);
/// 1, 4 or 8 bits with a palette, 16, 24 or 32 bits with masks; no run-length coding.
Result<Image> decode_bmp(std::span<const std::byte> file);
/// P1 to P6, up to 16 bits.
Result<Image> decode_pnm(std::span<const std::byte> file);
/// Palette, grey and true colour, 8 to 32 bits, run-length coded or not, any corner first.
Result<Image> decode_tga(std::span<const std::byte> file);
bool looks_like_tga(std::span<const std::byte> file);

}  // namespace palpable::sources
