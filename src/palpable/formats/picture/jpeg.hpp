// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>

namespace palpable::formats {

/// Decodes a baseline or progressive JPEG: grey, YCbCr, RGB or CMYK (converted to RGB). Data after its end
/// marker is ignored. The EXIF orientation is not applied (sources::read_picture does that). Errors:
/// invalid_input for files that are damaged or truncated (libjpeg alone would fill the missing part with
/// grey) or larger than kMaxPixels (checked before memory is allocated).
Result<Image> decode_jpeg(std::span<const std::byte> file);

}  // namespace palpable::formats
